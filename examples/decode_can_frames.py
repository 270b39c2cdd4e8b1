"""Read frames of the vehicle's CAN bus, and see what a checksum and a counter are worth.

The CAN database `glider.dbc` says what the bytes mean. A decoder has no port: frames come from an adapter, from a log
of candump or, as here, from an encoder.
"""

from stommel.messages.codec import Decoder, Encoder, Received
from stommel.messages.frames import Frame
from stommel.messages.spoken import frame_of, frame_text, sentence

encoder, decoder = Encoder(), Decoder()
frames = [encoder.frame("Sync", vehicle_time=float(t)) for t in range(4)]

# as text of candump, and in words
for frame in frames[:2]:
    print(frame_text(frame), "is", sentence(frame, decoder.take(frame_of(frame_text(frame)))))

# a frame that comes twice is taken once
print("again:", sentence(frames[1], decoder.take(frames[1])))

# the third frame was lost: the next one is taken, and the loss is counted
print("after a gap:", sentence(frames[3], decoder.take(frames[3])), "-", decoder.lost.total(), "lost")

# no flipped bit gets through, wherever it is
found = 0
for bit in range(64):
    data = bytearray(frames[0].data)
    data[bit // 8] ^= 1 << bit % 8
    found += not isinstance(Decoder().take(Frame(frames[0].identifier, bytes(data))), Received)
print(f"{found} of 64 flipped bits are found")
