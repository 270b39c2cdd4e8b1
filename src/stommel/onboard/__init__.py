"""The vehicle's software: coordination, execution and the edge. Bytes, readings and time in; bytes and commands out."""
