#!/usr/bin/env python3
"""The runtime's archive must need nothing but what a freestanding compiler may call anywhere: memory copies, bit counts.

Usage: check_symbols.py NM ARCHIVE
"""
import re
import subprocess
import sys

listing = subprocess.run([sys.argv[1], "--format=posix", "--no-demangle", sys.argv[2]], stdout=subprocess.PIPE, check=True)
symbols = re.findall(r"^(\S+) ([A-Za-z])\b", listing.stdout.decode(), re.MULTILINE)
defined = {name for name, kind in symbols if kind != "U"}
if len(defined) < 10:
    sys.exit(f"only {len(defined)} symbols seen in {sys.argv[2]}: is it the archive that programs link?")
allowed = {"memcpy", "memset", "memmove", "memcmp", "_GLOBAL_OFFSET_TABLE_", "__stack_chk_fail"}
# The rest is what the compiler itself brings along for cores without such an instruction.
needed = {name for name, kind in symbols if kind == "U" and not re.fullmatch("__(popcount|clz|ctz)[sdt]i2", name)}
if needed - defined - allowed:
    sys.exit("the runtime needs what it promises not to need: " + ", ".join(sorted(needed - defined - allowed)))
