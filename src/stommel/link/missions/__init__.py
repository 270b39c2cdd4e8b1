"""Missions over the link: waypoints as MAVLink's mission items, whole orders files by their hash."""
