"""The shore station: server, archive and page, with which people watch, command and plan."""
