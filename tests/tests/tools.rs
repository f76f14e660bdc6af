//! Tools that nobody sees fail, since they do without: the cache of clones, and drivers that are unpacked.
//! Each runs in a project of a few empty files, against archives that are made here.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A file that decides what shaders are compiled to.
const SOURCE_OF_COMPILER: &str = "crates/spirv/src/reduce.rs";

/// A folder with copies of both tools, where they take a project to be.
struct Project {
    folder: tempfile::TempDir,
}

impl Project {
    fn new() -> Self {
        let project = Self { folder: tempfile::tempdir().expect("a folder") };
        let tools = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tools");
        for tool in ["cache", "drivers"] {
            let text = fs::read_to_string(tools.join(tool)).expect("the tool is there");
            project.script(&format!("tools/{tool}"), &text);
        }
        project.write("Cargo.lock", "name = \"shaderc\"\nversion = \"1\"\n");
        project.write("Cargo.toml", "[profile.dev]\ndebug = 0\n");
        for file in ["shaders-glsl/compiler/src/lib.rs", SOURCE_OF_COMPILER] {
            project.write(file, "");
        }
        project
    }

    fn place(&self, path: &str) -> PathBuf {
        self.folder.path().join(path)
    }

    fn write(&self, path: &str, text: &str) {
        let place = self.place(path);
        fs::create_dir_all(place.parent().expect("a folder")).expect("writable");
        fs::write(place, text).expect("writable");
    }

    fn script(&self, path: &str, text: &str) {
        self.write(path, text);
        fs::set_permissions(self.place(path), fs::Permissions::from_mode(0o755)).expect("writable");
    }

    fn read(&self, path: &str) -> String {
        fs::read_to_string(self.place(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
    }

    /// Names in a folder, in order; none where there is no folder.
    fn names(&self, path: &str) -> Vec<String> {
        let entries = fs::read_dir(self.place(path)).into_iter().flatten();
        let mut names: Vec<_> = entries
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort_unstable();
        names
    }

    /// Runs a tool with the cache at `cache`; programs in `bin` come before those of the system.
    fn run(&self, tool: &str, words: &[&str], cache: &str) -> Output {
        let path = std::env::var("PATH").expect("a path");
        let mut command = Command::new(self.place(&format!("tools/{tool}")));
        command.args(words).current_dir(self.folder.path()).env("RASRAY_CACHE", cache);
        command.env("PATH", format!("{}:{path}", self.place("bin").display()));
        for name in ["CARGO_TARGET_DIR", "RASRAY_DRIVER", "RASRAY_NEW_LAYERS", "SHADERC_LIB_DIR"] {
            command.env_remove(name);
        }
        command.output().expect("it starts")
    }

    /// Output of a tool that succeeds.
    fn said(&self, tool: &str, words: &[&str], cache: &str) -> String {
        let output = self.run(tool, words, cache);
        assert_eq!(output.status.code(), Some(0), "{tool} {words:?}: {}", stderr(&output));
        String::from_utf8(output.stdout).expect("text").trim_end().to_owned()
    }

    /// A target folder with a library, a crate of the workspace, and what both left in the folders of cargo.
    fn build(&self) {
        let hash = "0123456789abcdef";
        for name in ["glam", "rasray-scene"] {
            self.write(&format!("target/debug/.fingerprint/{name}-{hash}/lib"), "");
            self.write(&format!("target/debug/build/{name}-{hash}/output"), "");
        }
        self.write(&format!("target/debug/deps/libglam-{hash}.rlib"), "a library");
        self.write("target/debug/deps/librasray_scene-fedcba9876543210.rlib", "of the workspace");
    }
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn is_refused(output: &Output, says: &str) {
    assert_eq!(output.status.code(), Some(2), "{}", stderr(output));
    assert!(stderr(output).contains(says), "{says}: {}", stderr(output));
}

#[test]
fn libraries_are_kept_without_the_workspace_and_come_back() {
    let project = Project::new();
    project.build();
    let output = project.run("cache", &["store"], "cache");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    if stderr(&output).contains("no room") {
        eprintln!("skipped: less than 2 GiB are free for the cache");
        return;
    }
    let kept = project.names("cache/libraries");
    assert_eq!(kept.len(), 1, "{kept:?}");
    // Files that are there already stay.
    project.said("cache", &["restore"], "cache");
    assert_eq!(project.names("target/debug/deps").len(), 2);
    let forget = || fs::remove_dir_all(project.place("target")).expect("removed");
    forget();
    let said = stderr(&project.run("cache", &["restore"], "cache"));
    assert!(said.contains(&kept[0]), "{said}");
    assert_eq!(project.names("target/debug/deps"), ["libglam-0123456789abcdef.rlib"]);
    assert_eq!(project.read("target/debug/deps/libglam-0123456789abcdef.rlib"), "a library");
    assert_eq!(project.names("target/debug/.fingerprint"), ["glam-0123456789abcdef"]);
    assert_eq!(project.names("target/debug/build"), ["glam-0123456789abcdef"]);
    assert_eq!(project.names("target"), ["debug"], "nothing else is left");

    // An entry that is cut short is as good as none.
    forget();
    let entry = project.place(&format!("cache/libraries/{}", kept[0]));
    let bytes = fs::read(&entry).expect("the entry");
    fs::write(&entry, &bytes[..bytes.len() / 2]).expect("writable");
    assert_eq!(project.said("cache", &["restore"], "cache"), "");
    assert!(project.names("target").is_empty(), "{:?}", project.names("target"));
    fs::write(&entry, bytes).expect("writable");

    // Libraries of another lock file are others, and the three sets that were used last stay.
    for version in 2..=5 {
        project.write("Cargo.lock", &format!("name = \"shaderc\"\nversion = \"{version}\"\n"));
        project.said("cache", &["restore"], "cache");
        assert!(project.names("target/debug").is_empty(), "of another lock file");
        project.build();
        project.said("cache", &["store"], "cache");
        forget();
    }
    let left = project.names("cache/libraries");
    assert!(left.len() == 3 && !left.contains(&kept[0]), "{left:?}");
}

#[test]
fn a_cache_that_is_off_or_cannot_be_written_is_done_without() {
    let project = Project::new();
    project.build();
    let shaders = project.place("target/shaders").canonicalize().unwrap_or(project.place("target/shaders"));
    for (cache, place) in [("off", ""), ("file", "file")] {
        project.write("file", "no folder");
        let folder = project.said("cache", &["folder"], cache);
        assert!(folder.ends_with(place) && folder.is_empty() == place.is_empty(), "{folder}");
        let modules = PathBuf::from(project.said("cache", &["modules"], cache));
        assert_eq!(modules.file_name(), shaders.file_name(), "{modules:?}");
        project.said("cache", &["store"], cache);
        fs::rename(project.place("target"), project.place("kept")).expect("moved");
        project.said("cache", &["restore"], cache);
        assert!(project.names("target").is_empty());
        fs::rename(project.place("kept"), project.place("target")).expect("moved");
    }
    assert_eq!(project.read("file"), "no folder");
    let modules = project.said("cache", &["modules"], "cache");
    assert!(Path::new(&modules).is_dir() && modules.contains("/cache/modules/"), "{modules}");
    project.write(SOURCE_OF_COMPILER, "// Another one.\n");
    assert_ne!(project.said("cache", &["modules"], "cache"), modules, "of another compiler");
    is_refused(&project.run("cache", &["forget"], "cache"), "tools/cache restore");
}

/// apt and dpkg as the tool calls them, with an archive of one package that holds `library`.
fn archive(project: &Project, library: &str) {
    project.script(
        "bin/apt-get",
        "#!/bin/sh\ncase \"$*\" in\n  *indextargets*) cat \"$(dirname \"$0\")/lists\" ;;\n  \
         *update*) ;;\n  *download*) touch package.deb ;;\nesac\n",
    );
    project.write(
        "bin/lists",
        "http://archive.example/security bookworm-security\nhttp://archive.example/debian bookworm\n",
    );
    let put = format!("mkdir -p \"$3/usr/lib\"\necho driver > \"$3/usr/lib/{library}\"\n");
    project.script("bin/dpkg-deb", &format!("#!/bin/sh\n{put}"));
}

#[test]
fn drivers_are_unpacked_once_and_shared_between_clones() {
    let project = Project::new();
    archive(&project, "libvulkan_lvp.so");
    assert!(project.said("drivers", &["list"], "cache").contains("mesa-25: not here"));
    is_refused(&project.run("drivers", &["env", "mesa-25"], "cache"), "tools/drivers unpack mesa-25");
    project.said("drivers", &["unpack", "mesa-25"], "cache");
    assert!(project.said("drivers", &["list"], "cache").contains("mesa-25: here"));
    assert_eq!(project.names("target/drivers"), ["mesa-25"], "nothing of the package is left");
    assert_eq!(project.names("target/drivers/mesa-25"), ["icd.json", "libvulkan_lvp.so"]);
    let manifest = project.read("target/drivers/mesa-25/icd.json");
    assert!(manifest.contains("/target/drivers/mesa-25/libvulkan_lvp.so\""), "{manifest}");
    let found = project.said("drivers", &["run", "mesa-25", "printenv", "VK_DRIVER_FILES"], "cache");
    assert!(found.ends_with("/target/drivers/mesa-25/icd.json"), "{found}");

    // The next clone takes it from the cache, without an archive; without the cache it cannot.
    fs::remove_dir_all(project.place("target")).expect("removed");
    project.write("bin/lists", "");
    is_refused(&project.run("drivers", &["unpack", "mesa-25"], "off"), "no archive of Debian 12");
    project.said("drivers", &["unpack", "mesa-25"], "cache");
    assert_eq!(project.read("target/drivers/mesa-25/libvulkan_lvp.so"), "driver\n");
}

#[test]
fn drivers_that_are_not_to_be_had_are_named() {
    let project = Project::new();
    archive(&project, "libsomething_else.so");
    is_refused(&project.run("drivers", &["unpack", "mesa-25"], "cache"), "mesa-25 holds no such library");
    project.script(
        "bin/apt-get",
        "#!/bin/sh\ncase \"$*\" in\n  *indextargets*) echo x bookworm ;;\n  *download*) exit 1 ;;\nesac\n",
    );
    is_refused(&project.run("drivers", &["unpack", "mesa-25"], "cache"), "could not be downloaded");
    assert!(project.said("drivers", &["list"], "cache").contains("mesa-25: not here"));
    assert!(project.names("cache/drivers").is_empty(), "nothing of it is shared");
    is_refused(&project.run("drivers", &["unpack", "mesa-26"], "cache"), "there is no driver 'mesa-26'");
    is_refused(&project.run("drivers", &["env", "layers"], "cache"), "'layers' is no driver");
    is_refused(&project.run("drivers", &[], "cache"), "tools/drivers unpack");
}
