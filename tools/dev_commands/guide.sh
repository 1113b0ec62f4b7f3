# The rows, tables and figures of docs/guide.

# A part is one of the study (bench/study) and its options; its rows are kept in build/guide/PART.jsonl.
guide_parts=(growth subdivision volumes obb builders ladder traversal cost_model deformation moving exactness load)
guide_folder=build/guide

# guide_rows PART MESH...: the rows of a part, to stdout
guide_rows() {
    local part=$1 study=$bench_folder/bench/espalier_bench_study few
    shift
    case $part in
        growth) "$study" growth ;;
        cost_model)
            "$study" cost_model --profile fast "$@"
            "$study" cost_model --profile fast --pairs "$@"
            "$study" cost_model --scene
            ;;
        deformation) # a bake over many poses of a large mesh takes minutes
            mapfile -t few < <(smaller_meshes "$@")
            "$study" deformation "${few[@]}" --times 2 --rounds 1 --rays 20000 --part refits --part bakes --part rays --part boxes
            ;;
        moving) "$study" moving --objects 10000 --speed 0.02 --steps 20 --aged 0 ;;
        *) "$study" "$part" "$@" ;;
    esac
}

guide() {
    local parts=("${guide_parts[@]}") name meshes part files=() started
    name=$(date -u +%F)_guide
    while [[ ${1-} == --* ]]; do
        [[ $# -ge 2 ]] || fail "guide: $1 takes a value"
        case $1 in
            --part) parts=("$2") ;;
            --name) name=$2 ;;
            *) fail "guide: unknown option '$1'; guide [--part PART] [--name NAME] [MESH...]" ;;
        esac
        shift 2
    done
    install_missing "${build_packages[@]}" libcli11-dev libembree-dev libbullet-dev libode-dev libfcl-dev libmeshoptimizer-dev zlib1g-dev nlohmann-json3-dev doctest-dev python3 >&2
    if [[ $# -gt 0 ]]; then meshes=("$@"); else mapfile -t meshes < <(measured_meshes); fi
    [[ ${#meshes[@]} -gt 0 ]] || fail "guide: there are no meshes to measure"
    build_bench espalier_bench_study
    mkdir -p "$guide_folder"
    for part in "${parts[@]}"; do
        started=$SECONDS
        guide_rows "$part" "${meshes[@]}" >"$guide_folder/$part.partial" || fail "guide: the part '$part' failed"
        mv "$guide_folder/$part.partial" "$guide_folder/$part.jsonl"
        echo "$part: $((SECONDS - started)) s"
    done
    for part in "${guide_parts[@]}"; do
        [[ -f $guide_folder/$part.jsonl ]] || fail "guide: the part '$part' was never measured; run guide without --part"
        files+=("$guide_folder/$part.jsonl")
    done
    publish_rows "$name" "${files[@]}"
    python3 bench/guide/report.py "bench/results/$name.jsonl"
}

guide "$@"
