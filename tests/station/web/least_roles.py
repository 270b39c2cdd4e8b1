"""The least role of every route; a route that is not here, or says something else, fails the tests."""

PUBLIC, VIEWER, PILOT, HOLDER, ADMIN = "public", "viewer", "pilot", "holder", "admin"
"""`holder` is a pilot who holds command of the vehicle, which is taken silently where nobody has it."""

V = "/api/vehicles/{vehicle}"
LEAST_ROLES: dict[tuple[str, str], str] = {
    # station and people
    ("GET", "/api/station"): PUBLIC,
    ("GET", "/api/openapi.json"): VIEWER,
    ("POST", "/api/session"): PUBLIC,
    ("DELETE", "/api/session"): PUBLIC,
    ("PUT", "/api/session/password"): VIEWER,
    ("GET", "/api/users"): ADMIN,
    ("POST", "/api/users"): ADMIN,
    ("PATCH", "/api/users/{name}"): ADMIN,
    ("DELETE", "/api/users/{name}"): ADMIN,
    ("GET", "/api/tokens"): VIEWER,
    ("POST", "/api/tokens"): VIEWER,
    ("DELETE", "/api/tokens/{token}"): VIEWER,
    ("GET", "/api/audit"): ADMIN,
    # alarms, alerts, the log book
    ("GET", "/api/alarms"): VIEWER,
    ("POST", "/api/alarms/{alarm}/acknowledge"): PILOT,
    ("GET", f"{V}/limits"): VIEWER,
    ("PUT", f"{V}/limits/{{channel}}"): PILOT,
    ("DELETE", f"{V}/limits/{{channel}}"): PILOT,
    ("GET", "/api/alerts"): VIEWER,
    ("POST", "/api/alerts/test"): ADMIN,
    ("GET", "/api/notes"): VIEWER,
    ("POST", "/api/notes"): PILOT,
    ("GET", f"{V}/log"): VIEWER,
    ("GET", "/api/layers"): VIEWER,
    ("POST", "/api/layers"): ADMIN,
    ("POST", "/api/layers/image"): ADMIN,
    ("GET", "/api/layers/{layer}/image"): VIEWER,
    ("DELETE", "/api/layers/{layer}"): ADMIN,
    ("GET", f"{V}/holder"): VIEWER,
    ("POST", f"{V}/holder"): PILOT,
    ("DELETE", f"{V}/holder"): PILOT,
}
