"""The compass: PNI TCM3 and TCM5, binary protocol of manual 1007537 r12 and, where named, 1014688."""
