#!/usr/bin/env bash
# run.sh PYTHON PACKAGE [LIBRARY [COMMAND]]: runs the tests of the package in a folder. Skipped, with status 77, without NumPy or pytest.
set -euo pipefail
python=$1 package=$2 library=${3-} command=${4-}
if ! "$python" -c 'import numpy, pytest' 2>/dev/null; then
    echo "skipped: $python has no NumPy or no pytest (python3-numpy, python3-pytest)"
    exit 77
fi
PYTHONPATH=$package ESPALIER_LIBRARY=$library ESPALIER_COMMAND=$command exec "$python" -B -m pytest -q -p no:cacheprovider "$(dirname "${BASH_SOURCE[0]}")"
