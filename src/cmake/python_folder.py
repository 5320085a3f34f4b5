"""python_folder.py PREFIX: the folder of PREFIX in which this Python looks for packages, relative to it. Where it looks
in none of PREFIX, lib/pythonX.Y/site-packages, which then must be named in PYTHONPATH."""

import os
import sys

prefix = sys.argv[1]
for folder in sys.path:
    inner = os.path.relpath(folder, prefix)
    # Not /usr/local for /usr.
    if inner.split(os.sep)[0] == "lib" and os.path.basename(folder) in ("dist-packages", "site-packages"):
        print(inner)
        break
else:
    print(f"lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages")
