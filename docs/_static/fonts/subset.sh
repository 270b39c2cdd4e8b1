#!/bin/sh
# Makes stommel-math.woff2: the part of TeX Gyre Termes Math that these pages use, under a name of its own.
# Usage: subset.sh texgyretermes-math.otf   (Debian: fonts-texgyre-math; needs pip install "fonttools[woff]")
set -eu
here=$(dirname "$0")
pyftsubset "$1" --output-file="$here/stommel-math.otf" --layout-features=math,ssty,dtls --notdef-outline \
  --name-IDs='*' --unicodes="U+0020-007E,U+00A0-00BF,U+00D7,U+00F7,U+02C6-02DD,U+0300-030C,U+0391-03D6,U+03F1,U+03F5,\
U+2016,U+2026,U+2032-2034,U+2044,U+2061-2064,U+20D7,U+2102-2115,U+211D,U+2190-2194,U+21D0-21D4,U+2200-220F,U+2211-221E,\
U+2223-222B,U+2243-2265,U+22A4-22A5,U+22C5,U+23DC-23DF,U+27E8-27E9,\
U+1D434-1D49B,U+1D538-1D550,U+1D6A4-1D6A5,U+1D6E2-1D755,U+1D7CE-1D7D7"
python - "$here/stommel-math.otf" "$here/stommel-math.woff2" <<'PYTHON'
import sys
from fontTools.ttLib import TTFont
font = TTFont(sys.argv[1])
for record in font["name"].names:
    if record.nameID in (1, 4, 16):
        record.string = "Stommel Math"
    elif record.nameID == 6:
        record.string = "StommelMath"
font["CFF "].cff.fontNames[0] = "StommelMath"
font.flavor = "woff2"
font.save(sys.argv[2])
PYTHON
rm "$here/stommel-math.otf"
