//! What an editor asks, asked of small texts. `‸` marks the place in a text, and is not part of it.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail loudly")]

use hray_core::Image;
use hray_lang::diagnostic::{Severity, Span};
use hray_lang::hry::assets::{AssetError, Assets};
use hray_lang::hry::eval::Limits;
use hray_lang::hry::ide::{Analysis, FileId, Suggestion, SymbolKind, library_text, rename};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Files by their paths.
#[derive(Clone, Default)]
struct Files(BTreeMap<String, String>);

impl Files {
    fn new(files: &[(&str, &str)]) -> Self {
        Self(files.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())).collect())
    }

    fn with(&self, more: &BTreeMap<String, String>) -> Self {
        Self(self.0.iter().chain(more).map(|(path, text)| (path.clone(), text.clone())).collect())
    }
}

impl Assets for Files {
    fn text(&self, path: &str) -> Result<String, AssetError> {
        self.0.get(path).cloned().ok_or(AssetError::NotFound)
    }

    fn image(&self, _path: &str) -> Result<Arc<Image>, AssetError> {
        Err(AssetError::NotFound)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let inside = |path: &&String| path.rsplit_once('/').map_or("", |(folder, _)| folder) == folder;
        self.0.keys().filter(inside).cloned().collect()
    }
}

const PALETTE: &str =
    "--| The colour of\n--| dried ink.\nink : Color\nink = #102030\n_hidden = 1\npaper = mix ink white 0.9\n";

fn files() -> Files {
    Files::new(&[("palette.hry", PALETTE), ("lib/shapes.hry", "ball = sphere {}\n"), ("wood.png", "")])
}

/// The text without its mark, analysed, and where the mark was.
fn at(marked: &str) -> (Analysis, usize) {
    let offset = marked.find('‸').expect("a mark");
    let text = format!("{}{}", &marked[..offset], &marked[offset + '‸'.len_utf8()..]);
    (Analysis::new("scene.hry", text.into(), &files()), offset)
}

fn complete(marked: &str) -> Vec<Suggestion> {
    let (analysis, offset) = at(marked);
    analysis.completions(offset, &files())
}

fn labels(marked: &str) -> Vec<String> {
    let mut found = complete(marked);
    found.sort_by_key(|suggestion| suggestion.rank);
    found.into_iter().map(|suggestion| suggestion.label).collect()
}

fn hover(marked: &str) -> (String, String) {
    let (analysis, offset) = at(marked);
    let hover = analysis.hover(offset).unwrap_or_else(|| panic!("no hover in {marked}"));
    (hover.code, hover.text)
}

#[test]
fn hover_tells_type_and_documentation() {
    let (code, text) =
        hover("--| Half of it.\nhalf : Number -> Number\nhalf x = x / 2\nscene = { depth = ha‸lf 4 }");
    assert_eq!((code.as_str(), text.as_str()), ("half : Number -> Number", "Half of it."));
    assert_eq!(hover("f x = sin ‸x\nscene = { depth = f 1 }").0, "x : Number");
    assert!(hover("x = si‸n 1").1.starts_with("Sine"));
    let (code, text) = hover("x = sph‸ere {}");
    assert_eq!(code, "sphere : { ... } -> Shape");
    assert!(text.contains("`radius` : `Number`, in scene units, greater than 0, `1` by default"), "{text}");
    let (code, text) = hover("x = sphere { rad‸ius = 1 }");
    assert_eq!(code, "radius : Number");
    assert!(text.contains("Distance from the centre") && text.contains("A field of `sphere`"), "{text}");
    assert_eq!(hover("f : Nu‸mber -> Hit\n").1, "A number. Angles are numbers in radians: `180deg`.");
    assert!(at("x = 1 -- no‸thing").0.hover(11).is_none());
}

#[test]
fn hover_shows_colours_and_what_is_imported() {
    let (analysis, offset) = at("import \"palette.hry\" (ink)\nx = i‸nk");
    let hover = analysis.hover(offset).unwrap();
    assert_eq!(hover.code, "ink : Color");
    assert_eq!(hover.text, "The colour of\ndried ink.\n\nFrom `palette.hry`.");
    assert_eq!(hover.color.unwrap().map(|part| (part * 255.0).round()), [16.0, 32.0, 48.0]);
    let (analysis, offset) = at("x = go‸ld");
    assert!(analysis.hover(offset).unwrap().color.is_some());
    let (analysis, offset) = at("é = 1\nx = #ff‸8000");
    let hover = analysis.hover(offset).unwrap();
    assert_eq!((hover.code.as_str(), hover.color), ("#ff8000 : Color", Some([1.0, 128.0 / 255.0, 0.0])));
    assert!(hover_import().contains("`ink`, `_hidden`, `paper`"));
}

fn hover_import() -> String {
    hover("import \"pal‸ette.hry\" (ink)\nx = ink").1
}

#[test]
fn fields_are_completed_with_defaults_and_without_those_given() {
    for marked in
        ["x = point { ‸ }", "x = point { ‸", "x = point { intensity = 1, ‸ }", "x = point {\n  ‸\n}\ny = 1"]
    {
        let found = labels(marked);
        assert_eq!(found.first().map(String::as_str), Some("position"), "{marked}");
        assert_eq!(found.contains(&"intensity".to_owned()), !marked.contains("intensity"), "{marked}");
    }
    let found = complete("x = spotlight { position = (0, 5, 0), an‸ }");
    let angle = found.iter().find(|suggestion| suggestion.label == "angle").unwrap();
    assert_eq!(angle.detail, "Number = 40deg");
    assert_eq!(angle.snippet.as_deref(), Some("angle = ${1:40deg}"));
    assert!(angle.documentation.contains("In radians"), "{}", angle.documentation);
    assert_eq!(angle.span.end - angle.span.start, 2);
    assert!(labels("scene = { ‸ }").starts_with(&["size".into(), "depth".into()]));
    assert!(labels("scene t =\n  let a = 1\n  in { depth = a, ‸ }").contains(&"objects".into()));
    for marked in ["{ ‸ } ] }", "{ ‸ ] }", "{ ‸", "{ ra‸", "{ center = up, ‸\ny = { a = 1 }"] {
        assert!(
            labels(&format!("scene = {{ objects = [ sphere {marked}")).contains(&"radius".into()),
            "{marked}"
        );
    }
    assert!(!labels("scene = { objects = [ sphere { radius = ‸ } ] }").contains(&"radius".into()));
}

#[test]
fn fields_of_other_records_are_completed() {
    assert_eq!(labels("x h = wood { light = gold, ‸ } h"), ["dark", "grain", "rings"]);
    assert_eq!(labels("f : Hit -> Hit\nf h = { h | p = h.p, ‸ }"), ["world", "normal", "uv", "time"]);
    assert_eq!(labels("x = classic { color = wood { light = red, da‸ } }"), ["dark", "grain", "rings"]);
}

#[test]
fn what_follows_a_point_is_completed() {
    assert_eq!(labels("f : Hit -> Vec3\nf h = h.‸"), ["p", "world", "normal", "uv", "time"]);
    assert_eq!(labels("f : Hit -> Number\nf h = h.p.‸ + 1"), ["x", "y", "z", "xy", "xz", "yz"]);
    assert_eq!(labels("c = #fff\nx = c.‸\ny = 2"), ["r", "g", "b"]);
    assert_eq!(labels("r = { width = 1, name = \"é\" }\nx = r.wi‸"), ["name", "width"]);
    assert_eq!(labels("import \"palette.hry\" as p\nx = p.‸"), ["ink", "paper"]);
}

#[test]
fn names_in_scope_are_completed() {
    let found = complete("import \"palette.hry\"\ndouble x = x * 2\nf a = let b = a in ‸\ny = 1");
    let rank = |label: &str| found.iter().find(|s| s.label == label).map(|s| (s.rank, s.detail.clone()));
    assert!(rank("a").is_some_and(|(rank, _)| rank == 0) && rank("b").is_some());
    assert_eq!(rank("double").map(|(rank, _)| rank), Some(1));
    assert_eq!(rank("ink"), Some((1, "Color".into())));
    assert_eq!(rank("sphere"), Some((2, "{ ... } -> Shape".into())));
    assert_eq!(rank("sin"), Some((2, "Number -> Number".into())));
    assert_eq!(rank("if").map(|(rank, _)| rank), Some(3));
    assert_eq!(rank("_decode"), None);
    assert!(labels("x = sphere { radius = s‸ }").contains(&"sqrt".into()));
    assert!(labels("x = [ s | s‸ <- [0 .. 1] ]").is_empty());
}

#[test]
fn types_imports_and_the_top_are_completed() {
    assert!(labels("f : ‸").contains(&"Vec3".into()));
    assert!(labels("f : Number -> V‸").contains(&"Vec3".into()));
    assert!(labels("sc‸").contains(&"scene".into()));
    assert!(labels("x = 1\n‸").contains(&"import".into()));
    assert_eq!(labels("import \"pal‸\""), ["palette.hry"]);
    assert_eq!(labels("import \"‸"), ["palette.hry"]);
    assert_eq!(labels("import \"lib/‸\""), ["lib/shapes.hry"]);
    assert_eq!(labels("import \"palette.hry\" (ink, ‸)"), ["paper"]);
    assert_eq!(labels("x = image \"w‸\""), ["wood.png"]);
    for nothing in ["x = 12‸", "x = 1 -- a ‸", "x = \"a‸\"", "x = #ff‸", "{- ‸ -}", "f ‸x = 1"] {
        assert!(complete(nothing).is_empty(), "{nothing}");
    }
}

#[test]
fn definitions_are_found_here_there_and_in_the_library() {
    let goto = |marked| {
        let (analysis, offset) = at(marked);
        let place = analysis.definition(offset)?;
        let text = match &place.file {
            FileId::Own(path) if path == "scene.hry" => analysis.text().to_string(),
            FileId::Own(path) => files().text(path).unwrap(),
            FileId::Library(name) => library_text(name).unwrap().to_owned(),
        };
        Some((place.file.clone(), place.span.start, place.span.text(&text).to_owned()))
    };
    let own = |path: &str| FileId::Own(path.into());
    assert_eq!(goto("é = 1\nx = ‸é"), Some((own("scene.hry"), 0, "é".into())));
    assert_eq!(goto("f a = let b = a in ‸b").unwrap().1, 10);
    let ink = PALETTE.find("ink =").unwrap();
    assert_eq!(goto("import \"palette.hry\" (ink)\nx = in‸k"), Some((own("palette.hry"), ink, "ink".into())));
    assert_eq!(goto("import \"palette.hry\" (i‸nk)\nx = ink"), Some((own("palette.hry"), ink, "ink".into())));
    assert_eq!(
        goto("import \"palette.hry\" as p\nx = p.i‸nk"),
        Some((own("palette.hry"), ink, "ink".into()))
    );
    assert_eq!(goto("import \"pal‸ette.hry\"\nx = ink"), Some((own("palette.hry"), 0, String::new())));
    assert_eq!(
        goto("x = smooth‸step").map(|(file, _, text)| (file, text)),
        Some((FileId::Library("prelude"), "smoothstep".into()))
    );
    assert_eq!(
        goto("x = si‸n").map(|(file, _, text)| (file, text)),
        Some((FileId::Library("builtin"), "sin".into()))
    );
    assert_eq!(goto("x = sphere { ra‸dius = 1 }").unwrap().2, "radius");
    assert_eq!(goto("x = 1 ‸"), None);
}

#[test]
fn references_are_found_in_all_files() {
    let (analysis, offset) = at("import \"palette.hry\" (ink)\nx = [ink, i‸nk]");
    let places = analysis.references(offset, true);
    let of = |path: &str| places.iter().filter(|place| place.file == FileId::Own(path.into())).count();
    // In the palette: the annotation, the definition and a use; here: the import and two uses.
    assert_eq!((of("palette.hry"), of("scene.hry")), (3, 3));
    assert_eq!(analysis.references(offset, false).len(), 5);
    let (analysis, offset) = at("f x = x + (\\x -> ‸x) 1");
    assert_eq!(analysis.references(offset, true).len(), 2);
}

/// The files after a renaming, or why it is refused.
fn renamed(marked: &str, new: &str) -> Result<BTreeMap<String, String>, String> {
    let (analysis, offset) = at(marked);
    let renaming = analysis.renaming(offset)?;
    let scene = BTreeMap::from([("scene.hry".to_owned(), analysis.text().to_string())]);
    let all = files().with(&scene);
    let reread = |path: &str, changed: &BTreeMap<String, String>| {
        let files = all.with(changed);
        Some(Analysis::new(path, files.text(path).ok()?.into(), &files))
    };
    let edits = rename(&[&analysis], &renaming, new, |path| all.text(path).ok(), reread)?;
    let mut texts = all.0.clone();
    for edit in edits.iter().rev() {
        let text = texts.get_mut(&edit.path).unwrap();
        text.replace_range(edit.span.start..edit.span.end, &edit.text);
    }
    Ok(texts)
}

#[test]
fn renaming_changes_every_use_and_keeps_fields() {
    let scene = |marked, new| renamed(marked, new).map(|texts| texts["scene.hry"].clone());
    assert_eq!(
        scene("é : Number\né = 1\nx = ‸é + é", "width").unwrap(),
        "width : Number\nwidth = 1\nx = width + width"
    );
    assert_eq!(scene("f radius = sphere { ra‸dius }", "r").unwrap(), "f r = sphere { radius = r }");
    assert_eq!(scene("f { radius } = ra‸dius", "r").unwrap(), "f { radius = r } = r");
    assert_eq!(scene("f x = let y‸ = x in y + y", "sum").unwrap(), "f x = let sum = x in sum + sum");
    let both = renamed("import \"palette.hry\" (ink)\nx = ‸ink", "blackInk").unwrap();
    assert_eq!(both["scene.hry"], "import \"palette.hry\" (blackInk)\nx = blackInk");
    assert!(
        both["palette.hry"].contains("blackInk : Color\nblackInk = #102030")
            && both["palette.hry"].contains("mix blackInk")
    );
}

#[test]
fn renaming_is_refused_where_it_would_change_the_meaning() {
    for (marked, new, why) in [
        ("a = 1\nb = ‸a", "b", "already means"),
        ("a = 1\nf b = ‸a + b", "b", "already means"),
        ("f a b = a + ‸b", "a", "already means"),
        ("f a = sin ‸a", "sin", "already means"),
        ("a = ‸sin 1", "sine", "belongs to the library"),
        ("x = ‸sphere {}", "ball", "belongs to the library"),
        ("x = sphere { ‸radius = 1 }", "r", "is a field of `sphere`"),
        ("‸scene = { }", "world", "is called `scene`"),
        ("a = ‸b", "c", "not decided here"),
        ("a = 1 ‸", "c", "no name here"),
        ("‸a = 1", "let", "a word of the language"),
        ("‸a = 1", "A", "capital"),
        ("‸a = 1", "b c", "is no name"),
        ("‸a = 1", "1a", "is no name"),
        ("‸a = 1", "", "is no name"),
        ("‸a = 1", "_", "is no name"),
    ] {
        let refused = renamed(marked, new).expect_err(marked);
        assert!(refused.contains(why), "{marked}: {refused}");
    }
}

#[test]
fn remarks_are_placed_in_the_file_that_is_edited() {
    let analysis = Analysis::new("scene.hry", "x = gld".into(), &files());
    let remarks = analysis.remarks();
    let [remark] = remarks.as_slice() else { panic!("{remarks:?}") };
    assert_eq!((remark.severity, remark.span), (Severity::Error, Span::new(4, 7)));
    assert_eq!(remark.fix.as_ref().map(|fix| fix.replacement.as_str()), Some("gold"));
    // A mistake in an imported file is shown at the import.
    let broken = Files::new(&[("a.hry", "import \"b.hry\"\ny = z"), ("b.hry", "z = 1 +")]);
    let analysis = Analysis::new("scene.hry", "import \"a.hry\"\nx = y".into(), &broken);
    let remark = &analysis.remarks()[0];
    assert_eq!(remark.span, Span::new(7, 14));
    assert!(remark.message.starts_with("in \"b.hry\": "), "{}", remark.message);
    assert_eq!(remark.related[0].0.file, FileId::Own("b.hry".into()));
    // A file to be imported needs no scene.
    assert_eq!(Analysis::new("palette.hry", PALETTE.into(), &files()).remarks(), []);
    // Classic files.
    let classic = Analysis::new("old.hry", "renderDescr ( resolution".into(), &files());
    assert!(classic.is_classic() && !classic.remarks().is_empty() && classic.hover(3).is_none());
}

#[test]
fn evaluation_adds_what_it_finds_and_ends() {
    let limits = Limits { steps: 100_000, list: 1000, memory: 1 << 24, ..Limits::default() };
    let evaluated = |text: &str| {
        let analysis = Analysis::new("scene.hry", text.into(), &files());
        assert_eq!(analysis.remarks().iter().filter(|r| r.severity == Severity::Error).count(), 0, "{text}");
        analysis.evaluated(&files(), &limits)
    };
    let found = evaluated("scene = { depth = at 3 [1] }");
    assert_eq!((found.len(), found[0].severity), (1, Severity::Error));
    let found = evaluated("scene = { depth = iterate 1e9 (\\x -> x < 0) (\\x -> x + 1) 0 }");
    assert_eq!((found.len(), found[0].severity), (1, Severity::Warning), "{found:?}");
    assert_eq!(evaluated("scene = { objects = [ sphere {} ], lights = [ ambient {} ] }"), []);
    assert_eq!(evaluated("x = at 3 [1]"), []);
}

#[test]
fn colours_are_listed_and_written_in_other_ways() {
    let text = "a = #f00\nb = rgb 0 1 0\nc x = rgb x 0 0\nd = f #00f (hsl 120deg 1 0.5)\nf = mix";
    let analysis = Analysis::new("scene.hry", text.into(), &files());
    let colors = analysis.colors();
    let texts: Vec<&str> = colors.iter().map(|color| color.span.text(text)).collect();
    assert_eq!(texts, ["#f00", "rgb 0 1 0", "#00f", "hsl 120deg 1 0.5"]);
    assert_eq!(colors[3].color.map(|part| (part * 1000.0).round()), [0.0, 1000.0, 0.0]);
    let ways = |at: usize| -> Vec<String> {
        let ways = analysis.presentations(colors[at].span, [1.0, 0.5, 0.0]);
        ways.into_iter().map(|way| way.text).collect()
    };
    assert_eq!(ways(0), ["#ff8000", "rgb 1 0.214 0", "hsl 30deg 1 0.5"]);
    assert_eq!(ways(2), ["#ff8000", "(rgb 1 0.214 0)", "(hsl 30deg 1 0.5)"]);
    assert_eq!(ways(3), ["#ff8000", "rgb 1 0.214 0", "hsl 30deg 1 0.5"]);
    // One that is defined anew is no colour of the library.
    assert_eq!(Analysis::new("scene.hry", "rgb a b c = 1\nx = rgb 1 0 0".into(), &files()).colors(), []);
}

#[test]
fn symbols_are_nested() {
    let analysis =
        Analysis::new("scene.hry", "f x =\n  let y = x\n  in y\nscene = { depth = f 1 }".into(), &files());
    let symbols = analysis.symbols();
    let [f, scene] = symbols.as_slice() else { panic!("{symbols:?}") };
    assert_eq!((f.name.as_str(), f.kind, scene.kind), ("f", SymbolKind::Function, SymbolKind::Scene));
    assert_eq!((f.children[0].name.as_str(), f.children[0].kind), ("y", SymbolKind::Value));
    assert!(f.detail.as_deref().is_some_and(|detail| detail.contains("->")));
    assert_eq!(f.name_span, Span::new(0, 1));
}

#[test]
fn any_offset_of_any_text_is_answered() {
    let texts = [
        "",
        "é",
        "scene = { objects = [ sphere { ",
        "x = h.",
        "import \"",
        "f x = let",
        "{- é",
        "x = \"é",
        "= = =",
        "a.b.c.",
        "\\ ->",
        "renderDescr ( é",
        "x = match 1 { _ -> é, ",
        "f : -> {",
        "import \"palette.hry\" (",
        "\u{feff}x = 1",
        "x = #é",
        "x = { y | ",
    ];
    for text in texts {
        let analysis = Analysis::new("scene.hry", text.into(), &files());
        let (_, _, _) = (analysis.remarks(), analysis.colors(), analysis.symbols());
        for offset in 0..text.len() + 3 {
            let (_, _) = (analysis.hover(offset), analysis.completions(offset, &files()));
            let (_, _) = (analysis.definition(offset), analysis.references(offset, true));
            let _ = analysis.renaming(offset);
            let _ = analysis.presentations(Span::new(offset, offset + 1), [2.0, -1.0, f64::NAN]);
        }
    }
}
