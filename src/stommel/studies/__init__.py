"""Studies: many missions over any field of vehicle, mission, ocean and sensors, on all cores or on a cluster."""
