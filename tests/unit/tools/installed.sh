#!/bin/bash
# installed.sh BUILD FOLDER: installs the whole of BUILD and checks a scene with what lies there, from elsewhere.
set -euo pipefail
build=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder/elsewhere"
cmake --install "$build" --prefix "$folder/prefix" >"$folder/install.log"
grep -q '/littoral/coupler/partner.hpp$' "$folder/install.log"
grep -q '/cmake/littoral/littoralConfig.cmake$' "$folder/install.log"
cd "$folder/elsewhere"
env -u LITTORAL_BIN PYTHONDONTWRITEBYTECODE=1 "$folder/prefix/bin/littoral" check still_water
