"""Parameters over the link: standard messages for all software, digests for ours."""
