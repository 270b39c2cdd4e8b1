"""The vehicle's software: coordination, execution, instruments. Bytes, readings and time in; bytes and commands out."""
