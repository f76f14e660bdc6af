//! Tests of the command line as a person types it.

use super::*;
use clap::CommandFactory;
use rasray_campaign::PAPERS;
use rasray_experiment::{FrameDefaults, INTEGRATORS, IntegratorSpec, RaySet};
use rasray_options::Value;
use rasray_scene::Environment;
use rasray_systems::Preset;

fn arguments(line: &str) -> Vec<OsString> {
    std::iter::once("rasray").chain(line.split_whitespace()).map(OsString::from).collect()
}

fn render(line: &str) -> RenderArguments {
    match parse(arguments(line)) {
        Ok(CommandLine { command: Command::Render(render), .. }) => *render,
        other => panic!("{line}: {other:?}"),
    }
}

fn refused(line: &str) -> AppError {
    match parse(arguments(line)) {
        Err(Refusal::Error(error)) => error,
        other => panic!("{line}: {other:?}"),
    }
}

#[test]
fn the_definition_is_consistent() {
    CommandLine::command().debug_assert();
}

#[test]
fn the_list_of_commands_is_whole() {
    let line = CommandLine::command();
    let names: Vec<_> = line.get_subcommands().map(|command| command.get_name()).collect();
    assert_eq!(names, COMMANDS);
}

#[test]
fn defaults_are_the_documented_ones() {
    let given = render("render cornell --output a.png");
    let frame = given.work.frame(FrameDefaults::default(), true).expect("defaults fit together");
    let system = given.system().expect("the exact structure");
    assert_eq!((system.system.name, system.preset), ("bvh", Preset::Robust));
    assert_eq!(system.spec().expect("known").structure(), "bvh");
    assert_eq!((frame.width, frame.height, frame.spp, frame.seed), (640, 360, 16, 1));
    assert_eq!(frame.integrator, IntegratorSpec::from(&INTEGRATORS[0]));
    assert_eq!((frame.integrator.name(), frame.integrator.get("bounces")), ("path", Some(Value::Whole(8))));
    assert_eq!(given.work.structure, StructureArguments::default());
}

/// Checks that options left out get values that suit the scene and its own camera only.
#[test]
fn a_picture_of_a_built_in_scene_suits_it() {
    for (line, expected) in [
        ("cornell", (256, 256, 32)),
        ("cornell --spp 4", (256, 256, 4)),
        ("cornell --size 640x360", (640, 360, 16)),
        ("cornell --eye 0,0,1 --target 0,0,0", (640, 360, 16)),
        ("walker", (640, 360, 16)),
        ("cornell.glb", (640, 360, 16)),
    ] {
        let frame = render(&format!("render {line} -o a.png")).frame().expect("defaults fit together");
        assert_eq!((frame.width, frame.height, frame.spp), expected, "{line}");
    }
}

/// Checks that an error about a negative value names the option that takes the value.
#[test]
fn a_negative_number_is_the_value_of_the_option_before_it() {
    let mut tried = 0;
    for command in CommandLine::command().get_subcommands() {
        let word = command.get_name();
        let takes = |argument: &&clap::Arg| argument.get_action().takes_values();
        for argument in command.get_arguments().filter(takes) {
            let Some(option) = argument.get_long() else { continue };
            for value in ["-1", "-.5", "-2x3", "-inf", "-1,2,3"] {
                let Err(Refusal::Error(error)) = parse(arguments(&format!("{word} --{option} {value}")))
                else {
                    continue;
                };
                let text = error.to_string();
                assert!(!text.contains("unexpected argument"), "{word} --{option} {value}: {text}");
                tried += 1;
            }
        }
    }
    assert!(tried > 200, "{tried}");
    assert!(refused("render cornell -1").to_string().contains("'-1'"));
    assert!(refused("render cornell -o a.png --validation -1").to_string().contains("--validation"));
    assert!(refused("render cornell -- -1").to_string().contains("'-1'"));
    assert_eq!(render("render cornell -o -1.png").output.as_deref(), Some(std::path::Path::new("-1.png")));
}

#[test]
fn negative_coordinates_are_values() {
    let given = render("render cornell -o a.png --eye -1,2,-3 --target 0,-1,0 --fov 30 --exposure -1.5");
    assert_eq!(given.work.view.eye, Some([-1.0, 2.0, -3.0]));
    assert_eq!(given.tone.exposure, Some(-1.5));
}

#[test]
fn a_comparison_takes_lists_and_addressed_options() {
    let line = "compare cornell --systems mmrt,brute-force --presets published,robust --ray-set eye,bounce \
                mmrt.march=samples --rays 10";
    match parse(arguments(line)) {
        Ok(CommandLine { command: Command::Compare(given), .. }) => {
            let names: Vec<_> = given.systems.iter().map(|system| system.name).collect();
            assert_eq!(names, ["mmrt", "brute-force"]);
            assert_eq!(given.ray_set, [RaySet::Eye, RaySet::Bounce]);
            assert_eq!(given.assignments, ["mmrt.march=samples"]);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn published_presets_take_the_frame_of_their_paper() {
    let frame = |line: &str| render(&format!("render cornell -o a.png {line}")).frame().expect("a frame");
    let of = |frame: &rasray_experiment::Frame| {
        (frame.integrator.name(), frame.primary.name(), frame.occluder.name())
    };
    let plain = ("path", "trace", "structure");
    for (line, expected) in [
        ("", plain),
        ("--system bvh", plain),
        ("--system mmrt", ("path", "raster", "structure")),
        ("--system mmrt --integrator path", plain),
        ("--system ldc --primary trace", plain),
        ("--system mmrt --preset published", ("path", "raster", "shadow-maps")),
        ("--system mmrt --preset published --shadow-resolution 64", ("path", "raster", "shadow-maps")),
        ("--system mmrt --preset published --occluder structure", ("path", "raster", "structure")),
        ("--system dirt --preset published", ("path", "raster", "structure")),
        ("--system dirt --preset published --adaptive 0.1", ("path", "trace", "structure")),
        ("--system dirt --preset published --aperture 0.01", ("path", "trace", "structure")),
        ("--system hu --preset published", ("whitted", "raster", "structure")),
        ("--system hu --preset published --primary trace", ("whitted", "trace", "structure")),
        ("--system hu --preset published --integrator path", plain),
        ("--system ldc --preset published", ("whitted", "raster", "structure")),
    ] {
        assert_eq!(of(&frame(line)), expected, "{line}");
    }
    let option = |line: &str, option| frame(line).integrator.values().text(option);
    let selective = "--system selective --preset published";
    assert_eq!(option(selective, "select").as_deref(), Some("reflective"));
    assert_eq!(option(selective, "ray-depth").as_deref(), Some("1"));
    assert_eq!(option(&format!("{selective} --ray-depth 2"), "ray-depth").as_deref(), Some("2"));
    assert_eq!(
        option(&format!("{selective} --integrator whitted"), "ray-depth"),
        option("--integrator whitted", "ray-depth")
    );
}

#[test]
fn options_of_another_integrator_are_refused() {
    let error = render("render cornell -o a.png --integrator ao --bounces 2")
        .work
        .frame(FrameDefaults::default(), true)
        .expect_err("bounces");
    assert!(error.help().contains("path"), "{error}");
    let error = render("render cornell -o a.png --ao-distance 2").frame().expect_err("ao distance");
    assert!(error.help().contains("ao"), "{error}");
}

#[test]
fn mistakes_are_two_lines_with_a_way_out() {
    let cases = [
        ("", "nothing was asked for", "rasray help"),
        ("rendr cornell", "rendr", "render"),
        ("render", "<SCENE>", "rasray render --help"),
        ("render cornell", "--output", "rasray render --help"),
        ("render cornell -o a.png --sppp 3", "--sppp", "--spp"),
        ("render cornell -o a.png --spp 0", "--spp", "rasray render --help"),
        ("render cornell -o a.png --size 10", "WIDTHxHEIGHT", "--help"),
        ("render cornell -o a.png --storage heap", "heap", "--help"),
        ("render cornell -o a.png --eye 0,0,0", "--target", "--help"),
        ("render cornell -o a.png --camera a --eye 0,0,0 --target 1,0,0", "--eye", "--help"),
        ("render cornell --report r.json --aov depth", "--output", "--help"),
        ("compare cornell", "--systems", "rasray compare --help"),
        ("render cornell -o a.png --march jump --samples 65536", "from 1 to 65535", "rasray render --help"),
        ("render cornell -o a.png -q -v", "--verbose", "--help"),
        ("help rendr", "rendr", "--help"),
        ("completions powder", "powder", "powershell"),
        ("show cornell", "show", "--help"),
    ];
    for (line, message, help) in cases {
        let error = refused(line);
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains(message), "{line}: {error}");
        assert!(error.help().contains(help), "{line}: {}", error.help());
        assert_eq!(error.lines().lines().count(), 2, "{line}");
    }
}

#[test]
fn help_and_version_are_text() {
    for line in [
        "--help",
        "render --help",
        "compare --help",
        "info --help",
        "--version",
        "help",
        "help render",
        "help man",
    ] {
        assert!(
            matches!(parse(arguments(line)), Err(Refusal::Text(text)) if text.contains("rasray")),
            "{line}"
        );
    }
}

#[test]
fn without_a_system_only_options_of_exact_structures_are_taken() {
    assert!(render("render cornell -o a.png --grid 64").system().is_ok());
    assert!(render("render cornell -o a.png --system mmrt --resolution 64").system().is_ok());
    for line in ["--preset published", "--storage llb", "--resolution 64", "--buckets 4"] {
        let error = render(&format!("render cornell -o a.png {line}")).system().expect_err(line);
        assert!(error.exit_code() == 2 && error.help().contains("--system"), "{line}: {error}");
    }
}

#[test]
fn how_much_is_said_stands_before_the_command_or_after_it() {
    for (line, quiet, verbose) in [
        ("info", false, false),
        ("-q info", true, false),
        ("info --quiet", true, false),
        ("info -v", false, true),
    ] {
        let talk = parse(arguments(line)).expect(line).talk;
        assert_eq!((talk.quiet, talk.verbose), (quiet, verbose), "{line}");
    }
}

/// Checks that whole numbers are accepted in the ranges that the help states.
#[test]
fn ranges_in_the_help_are_those_of_the_values() {
    let line = CommandLine::command();
    let mut tried = 0;
    for (word, rest) in [
        ("render", &["cornell", "--output=a.png", "--adaptive=0.1"][..]),
        ("compare", &["cornell", "--systems=mmrt"]),
    ] {
        let command = line.find_subcommand(word).expect("a command");
        let is_number =
            |argument: &&clap::Arg| argument.get_value_names().is_some_and(|names| names == ["N"]);
        for argument in command.get_arguments().filter(is_number) {
            let help = argument.get_help().map(ToString::to_string).unwrap_or_default();
            let words: Vec<_> =
                help.split([' ', ',', ';', ')', '[', ']']).filter(|word| !word.is_empty()).collect();
            let range = words.windows(3).find_map(|three| {
                let is_range = matches!(three[1], "to" | "or");
                Some((three[0].parse::<u64>().ok()?, three[2].parse::<u64>().ok()?)).filter(|_| is_range)
            });
            let Some((least, most)) = range else { continue };
            let option = argument.get_long().expect("every number is an option");
            let takes = |value: u64| {
                let own = format!("--{option}={value}");
                let words = ["rasray", word].into_iter().chain(rest.iter().copied()).chain([own.as_str()]);
                CommandLine::command().try_get_matches_from(words).is_ok()
            };
            assert!(takes(least) && takes(most), "--{option} {least} to {most}");
            assert!(!takes(most + 1) && (least == 0 || !takes(least - 1)), "--{option} {least} to {most}");
            tried += 1;
        }
    }
    assert!(tried > 20, "{tried}");
}

/// Checks every option that a help text names, since rows of libraries name options without knowing the
/// command line.
#[test]
fn every_option_that_a_help_names_is_one() {
    let line = CommandLine::command();
    let commands: Vec<_> = line.get_subcommands().collect();
    let known: Vec<_> = commands
        .iter()
        .flat_map(|command| command.get_arguments())
        .filter_map(|argument| argument.get_long())
        .collect();
    let mut named = 0;
    for argument in commands.iter().flat_map(|command| command.get_arguments()) {
        let values = argument.get_possible_values();
        let of_values = values.iter().filter_map(|value| value.get_help());
        for text in argument.get_help().into_iter().chain(of_values).map(ToString::to_string) {
            for word in text.split("--").skip(1) {
                let name = word.split(|letter: char| !letter.is_ascii_lowercase() && letter != '-').next();
                let name = name.unwrap_or_default();
                assert!(known.contains(&name) || name == "help", "--{name} of: {text}");
                named += 1;
            }
        }
    }
    assert!(named > 20, "{named}");
}

#[test]
fn an_environment_is_a_colour_or_a_map() {
    let read = |value: &str| {
        render(&format!("render cornell -o a.png --environment {value}")).work.reading.environment()
    };
    match read("1,0.5,0").expect("a colour") {
        Some(Environment::Constant(color)) => assert_eq!(color, [1.0, 0.5, 0.0]),
        other => panic!("{other:?}"),
    }
    for bad in ["white", "1,2", "0,-1,0", "1e39,0,0", "nan,0,0", "sky.png"] {
        assert_eq!(read(bad).expect_err(bad).exit_code(), 2);
    }
    let error = read("missing.hdr").expect_err("no such file");
    assert!(error.to_string().starts_with("missing.hdr: ") && error.help().contains(".hdr"), "{error}");
}

#[test]
fn every_plan_of_the_papers_asks_for_comparisons_that_can_be() {
    for (paper, item) in PAPERS.iter().flat_map(|paper| paper.items.iter().map(move |item| (paper, item))) {
        for small in [false, true] {
            let plan = item.plan(small).expect("a plan");
            for (_, one) in plan.comparisons() {
                let about = format!("{} {}: {:?}", paper.name, item.name, one.words);
                let given = comparison(&one.words).unwrap_or_else(|error| panic!("{about}: {error}"));
                let systems = given.systems().unwrap_or_else(|error| panic!("{about}: {error}"));
                let frame = given.work.frame(FrameDefaults::default(), true);
                assert!(!systems.is_empty() && frame.is_ok(), "{about}: {frame:?}");
            }
        }
    }
}
