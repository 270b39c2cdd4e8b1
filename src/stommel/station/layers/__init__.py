"""Chart layers of the station's own: GeoJSON, or an image with the bounds that it covers."""
