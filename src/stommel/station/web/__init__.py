"""The door: HTTP, WebSocket and the built page."""
