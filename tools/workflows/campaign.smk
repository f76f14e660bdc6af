# Makes the comparisons of a plan in shares, several at a time, and puts them together. For Snakemake 8 or later:
#
#   snakemake -s tools/workflows/campaign.smk --cores 2 --rerun-incomplete --config plan=plan.toml shards=4
#
# The same line goes on where it was stopped or killed: within a share, `--resume` makes only the runs that are not there.
# Shares at the same time on one machine slow each other: for times, --cores 1 or machines of one kind.

PLAN = config["plan"]                                  # of rasray ablate
SHARDS = int(config.get("shards", 4))
OUT = config.get("out", "out")
OPTIONS = config.get("options", "")                    # of rasray ablate: "--small"
RASRAY = config.get("rasray", "rasray")

# A wildcard matches anything, slashes too: without this a rule could take its own results for its input.
wildcard_constraints:
    shard=r"\d+",
    form=r"csv|md|html|jsonl",

NAMES = ["cells.jsonl", "table.csv", "report.md", "report.html"]

rule all:
    input:
        expand(f"{OUT}/{{name}}", name=NAMES),

# The runs are not declared as results: Snakemake removes those of a job that failed, and with them the runs that are done.
rule share:
    input:
        plan=PLAN,
    output:
        touch(f"{OUT}/{{shard}}.done"),
    # Where one of these changes, Snakemake runs the rule again.
    params:
        options=OPTIONS,
        share=lambda wildcards: f"{wildcards.shard}/{SHARDS}",
        folder=OUT,
    # A share that is killed is started again.
    retries: 2
    # One share per device: give --resources gpu=N as many as there are.
    resources:
        gpu=1,
    shell:
        "{RASRAY} ablate '{input.plan}' --output '{params.folder}' --shard {params.share} {params.options} --resume --quiet"

rule merge:
    input:
        expand(f"{OUT}/{{shard}}.done", shard=range(1, SHARDS + 1)),
    output:
        f"{OUT}/{{name}}.{{form}}",
    params:
        cells=[f"{OUT}/cells.{shard}-of-{SHARDS}.jsonl" for shard in range(1, SHARDS + 1)],
    shell:
        "{RASRAY} merge '{output}' {params.cells:q}"
