# Renders an animation in shares, several at a time, and puts their reports together. For Snakemake 8 or later:
#
#   snakemake -s tools/workflows/animation.smk --cores 2 --rerun-incomplete --config scene=walk.glb frames=0-99 shards=8
#
# The same line goes on where it was stopped or killed: within a share, `--resume` renders only frames that are not
# there whole. It also renders again what was made of another scene, or with other options. After images were removed,
# remove OUT/*.done as well, so that they are looked for.

SCENE = config["scene"]                                # .gltf or .glb with a clip
FRAMES = config.get("frames", "0-9")
SHARDS = range(1, int(config.get("shards", 4)) + 1)
OUT = config.get("out", "out")
OPTIONS = config.get("options", "")                    # of rasray render: "--size 1280x720 --spp 256"
RASRAY = config.get("rasray", "rasray")

# A wildcard matches anything, slashes too: without this a rule could take its own results for its input.
wildcard_constraints:
    shard=r"\d+",

rule all:
    input:
        f"{OUT}/frames.jsonl",

# Images and report are not declared as results: Snakemake removes those of a job that failed, and with them the frames
# that are done.
rule render:
    input:
        scene=SCENE,
    output:
        touch(f"{OUT}/{{shard}}.done"),
    # Where one of these changes, Snakemake runs the rule again.
    params:
        frames=FRAMES,
        options=OPTIONS,
        share=lambda wildcards: f"{wildcards.shard}/{len(SHARDS)}",
        images=f"{OUT}/frame.####.exr",
        report=f"{OUT}/{{shard}}.jsonl",
    # A share that is killed is started again.
    retries: 2
    # One share per device: give --resources gpu=N as many as there are.
    resources:
        gpu=1,
    shell:
        "{RASRAY} render '{input.scene}' --frames {params.frames} --shard {params.share} {params.options} "
        "--output '{params.images}' --report '{params.report}' --resume --quiet"

rule merge:
    input:
        expand(f"{OUT}/{{shard}}.done", shard=SHARDS),
    output:
        f"{OUT}/frames.jsonl",
    params:
        reports=[f"{OUT}/{shard}.jsonl" for shard in SHARDS],
    shell:
        "{RASRAY} merge '{output}' {params.reports:q}"
