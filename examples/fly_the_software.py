"""Fly the vehicle's own software in the loop, read the log that it wrote, and hold it against the truth.

Coordinator, both nodes and instruments fly the pool trial through CAN frames and instrument bytes. The log is all that
comes back from a real vehicle; what it is compared with only a simulation knows.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from stommel import dataset_of, load_mission
from stommel.messages.log.reader import read_log
from stommel.simulation.scenario.shipped import mission_path
from stommel.sitl.flight import fly
from stommel.sitl.log_folder import logbook_in
from stommel.sitl.system import System

mission = load_mission(mission_path("pool_trial"))
with TemporaryDirectory() as folder:
    logbook = logbook_in(Path(folder), mission)
    flown = fly(System(mission, logbook), logbook=logbook)
    logs = [read_log(path.read_bytes(), path.name) for path in sorted(Path(folder).iterdir())]
essential, detail = logs

# what the software did, in its own words
for record in essential.records:
    if record.kind == "event" and record.values[1] == "executive":
        print(f"{record.values[0]:6.0f} s  {record.values[2]}")

# what it believed, second by second, and what was true
seen = detail.columns("readings")
truth = dataset_of(flown)
start = truth["time"].values[0]
seconds = (truth["time"].values - start) / np.timedelta64(1, "s")
off = np.array(seen["depth"]) - np.interp(seen["t"], seconds, truth["depth"].values)

statuses = ", ".join(log.status for log in logs)
dives = max(essential.columns("decision")["dives"])
deepest, deepest_in_truth = max(seen["depth"]), float(truth["depth"].max())

print(f"{statuses}: {len(seen['t'])} decisions, {dives} dives")
print(f"greatest depth {deepest:.2f} m, in truth {deepest_in_truth:.2f} m; off by {off.std():.3f} m rms")
