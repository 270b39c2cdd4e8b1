"""Latest values and events, for whoever watches now; a slow watcher never slows the link."""
