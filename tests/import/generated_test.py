#!/usr/bin/env python3
"""Tests of OBJ, OFF, PLY, STL and 3MF, of formats that assimp reads, of files with a wrong name, of messages, and of files that are
made to cost time. All are written here.

Usage: generated_test.py PATH_TO_ESPALIER
"""

import resource
import sys
import tempfile

from generated.assimp import assimp
from generated.claims import Claims
from generated.digits import digits
from generated.hostile import hostile
from generated.messages import messages
from generated.names import names
from generated.obj import obj
from generated.off import off
from generated.packed import packed
from generated.ply import ply
from generated.source_names import source_names
from generated.stl import stl
from generated.three_mf import three_mf

BYTES = 4 << 30  # of memory, so that a claim of a file is not taken at its word


def main():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    with tempfile.TemporaryDirectory() as folder:
        claims = Claims(sys.argv[1], folder)
        for family in (obj, off, ply, stl, three_mf, digits, names, source_names, assimp, packed, messages, hostile):
            family(claims)
        if claims.failures:
            print(f"{claims.failures} claims failed")
        return 1 if claims.failures else 0


if __name__ == "__main__":
    sys.exit(main())
