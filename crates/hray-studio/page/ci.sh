#!/usr/bin/env bash
# The studio's page: types, whether the committed bundle is what the sources give, units, and the suite in a real browser
# against the real binary and the playground. Needs node 20 or later, npm's registry, and Debian's packages for the browser.
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    echo "crates/hray-studio/page: skipped, there is no node here"
    exit 0
fi
step() { printf -- '-- %s\n' "$*"; }

step "packages"
npm ci --no-audit --no-fund --loglevel=error

step "types"
npm run --silent check

step "the committed bundle is what the sources give"
fresh=$(mktemp -d)
trap 'rm -rf "$fresh"' EXIT
npx vite build --logLevel error --outDir "$fresh/dist" --emptyOutDir
diff -rq "$fresh/dist" ../dist || { echo "run \`npm run build\` in crates/hray-studio/page and commit crates/hray-studio/dist"; exit 1; }

step "units"
npm run --silent unit

# `ci.sh page` ends here, without a browser.
if [ "${1:-}" = page ]; then
    exit 0
fi

step "the browser"
if ! command -v chromium >/dev/null; then
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends chromium >/dev/null
fi

step "the binary and the playground"
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$root/target}
(cd "$root" && cargo build --release --locked --bin hray)
export HRAY_PLAYGROUND="$fresh/playground"
(cd "$root" && cargo xtask playground --out "$HRAY_PLAYGROUND")

step "the suite"
if [ -z "${HRAY_CLASSIC:-}" ] && [ -d "$root/../shared/classic" ]; then
    HRAY_CLASSIC=$(cd "$root/../shared/classic" && pwd)
    export HRAY_CLASSIC
fi
npm run --silent browser
