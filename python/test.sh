#!/usr/bin/env bash
# Builds the wheel and tests it in a fresh virtual environment. Needs Rust, Python 3.9 or later, and PyPI.
# PYTHON names another interpreter; ADSDV a built `adsdv`, with which reports are compared. Arguments go to pytest.
set -euo pipefail
cd "$(dirname "$0")"
export PYTHONDONTWRITEBYTECODE=1

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"${PYTHON:-python3}" -m venv "$scratch/venv"
python=$scratch/venv/bin/python
pip() { "$python" -m pip --disable-pip-version-check --quiet "$@"; }

pip install maturin pytest
for optional in mypy numpy pandas polars pyarrow 'dask[distributed]'; do
  pip install "$optional" || echo "$optional cannot be installed: what needs it is skipped"
done

"$python" -m maturin build --release --locked --interpreter "$python" --out "$scratch/wheels"
pip install --no-index "$scratch"/wheels/adsdv-*.whl
"$python" -m pytest -p no:cacheprovider -q tests "$@"
