"""What stands before the routes: hosts and origins, headers, sound bodies, the audit log."""
