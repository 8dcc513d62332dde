#!/usr/bin/env bash
# run.sh DOTTRACK_BOARD [ARGUMENTS...]: boots what prepare.sh has left in build/board; the findings go
# to standard output, the report and the logs to out/board. With --only camera,can fewer faults.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

harness=$1
shift
rm -rf out/board
exec "$harness" run tests/board/board.toml --image build/board/board.img \
  --observer build/board/observer.img --firmware /usr/share/AAVMF/AAVMF_CODE.fd \
  --variables build/board/variables.fd --out out/board "$@"
