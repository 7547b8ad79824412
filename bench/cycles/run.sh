#!/usr/bin/env bash
# Renders the benchmark scenes with Cycles into build/peers, as `./dev bench --peers [SPP]` does: wall seconds and, where
# build/peers/reference_<scene>.exr lies beside them, relMSE over the bunny's pixels against that.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
spp=${1:-16}
[[ $spp =~ ^[1-9][0-9]*$ ]] || { echo "samples per pixel: a number of at least 1, not '$spp'" >&2; exit 1; }
bunny=${NACRE_BUNNY:-../shared/bench/bunny_watertight.obj}
[[ -r $bunny ]] || { echo "There is no mesh $bunny; name it with NACRE_BUNNY=path." >&2; exit 1; }
mkdir -p build/peers

render() { # scene samples picture
    blender -b --factory-startup -P bench/cycles/render_scene.py -- "$1" --bunny "$bunny" --spp "$2" --out "$3" \
        >"$3.log" 2>&1 </dev/null || { tail -n 5 "$3.log" >&2; exit 1; }
    grep '^cycles ' "$3.log"
}

mask=build/peers/mask.exr
render mask 16 "$PWD/$mask" >/dev/null
for scene in marble diffuse; do
    picture=build/peers/cycles_$scene.exr reference=build/peers/reference_$scene.exr
    render "$scene" "$spp" "$PWD/$picture"
    if [[ -r $reference ]]; then
        python3 bench/relmse.py "$picture" "$reference" --mask "$mask"
    else
        echo "no $reference to compare with; mean over the bunny:"
        python3 bench/relmse.py "$picture" "$picture" --mask "$mask" | sed -n 1p
    fi
done
