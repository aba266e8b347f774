# shellcheck shell=bash
# For sourcing by the scripts beside it: works from the root of the repository, and says what happens.

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
root=$PWD

# One line that opens a phase.
say() { printf '== %s\n' "$*"; }

# The one line that helps, and the end.
die() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

export jobs # also for the functions that xargs runs
jobs=$(nproc)

# Every C++ file of ours, one a line.
sources() { find src apps tests bench examples \( -name '*.h' -o -name '*.inc' -o -name '*.cpp' \) -type f | sort; }

# A compiler cache makes a second build quick; it is used where it is installed and never asked for.
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache} CCACHE_BASEDIR=$root
fi
