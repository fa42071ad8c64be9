# surface_to_export NACRE: a small acquired surface, a.nacre in the current folder.
surface_to_export() {
    rm -rf capture a.nacre
    "$1" synth capture --shape bumpy --side 48 --lights 12 --noise 0 --give-lights --material 'ggx:diffuse=0.5,0.3,0.2;alpha=0.3' >/dev/null
    "$1" acquire capture --normals least-squares --quiet -o a.nacre
}
