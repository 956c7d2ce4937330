//! What a user sees of every kind of mistake. The snapshots are to be read as by someone who has never seen
//! the grammar: what was found, what was expected, how to mend it.

use crate::common::{SCENE, broken, shown};
use insta::assert_snapshot;

/// The mistakes of one kind: each a name and a change of the scene.
macro_rules! mistakes {
    ($($kind:ident { $($name:ident: $from:literal => $to:expr;)+ })+) => {$(
        #[test]
        fn $kind() {
            $(assert_snapshot!(
                concat!(stringify!($kind), "-", stringify!($name)),
                shown(broken($from, $to).as_bytes())
            );)+
        }
    )+};
}

mistakes! {
    numbers {
        integer_for_real: "sphere 40.0" => "sphere 40";
        integers_in_a_tuple: "(0.0,0.0,-150.0)" => "(0,0,-150)";
        real_for_integer: "0.3 60" => "0.3 60.0";
        real_that_is_not_whole: "0.3 60" => "0.3 60.5";
        reals_for_a_resolution: "(400,300)" => "(400.0,300.0)";
        no_digits_after_the_point: "sphere 40.0" => "sphere 40.";
        no_digits_before_the_point: "0.3 60" => ".3 60";
        exponent: "sphere 40.0" => "sphere 4e1";
        two_points: "sphere 40.0" => "sphere 4.0.0";
        minus_apart: "(0.0,0.0,-150.0)" => "(0.0,0.0,- 150.0)";
        minus_alone: "(0.0,0.0,-150.0)" => "(0.0,0.0,-)";
        plus: "(0.0,0.0,-150.0)" => "(0.0,0.0,+150.0)";
        typographic_minus: "(0.0,0.0,-150.0)" => "(0.0,0.0,−150.0)";
        decimal_comma: "sphere 40.0" => "sphere 40,0";
        decimal_commas: "(0.0,0.0,-150.0)" => "(0,0, 0,0, -150,0)";
        real_too_large: "sphere 40.0" => &format!("sphere 4{}.0", "0".repeat(400));
        integer_too_large: "0.3 60" => "0.3 99999999999999999999";
    }

    words {
        misspelt: "( sphere" => "( spere";
        capital: "( sphere" => "( Sphere";
        misspelt_noise: "perlinFire" => "perlinFir";
        misspelt_first_word: "renderDescr" => "renderDesc";
        misspelt_section: "{ background" => "{ backgroud";
        unknown_shape: "sphere 40.0 (0.0,0.0,-150.0)" => "torus 40.0 10.0 (0.0,0.0,-150.0)";
        unknown_noise: "perlinFire" => "perlinGranite";
        other_word: "( texture ( diff solid" => "( texture ( texture solid";
        plural: "(object ( sphere" => "(objects ( sphere";
        part_of_a_word: "(pointLight" => "(light";
        missing: "diff solid" => "solid";
        missing_shape: "sphere 40.0" => "40.0";
        missing_perlin: "perlin (perlinFire" => "perlinFire";
        missing_scene: "scene {" => "{";
        superfluous: "0.3 60" => "0.3 shine 60";
        doubled: "{ lights" => "{ lights lights";
    }

    brackets {
        missing_close: "-150.0) )" => "-150.0)";
        missing_open: "(object ( sphere" => "(object sphere";
        missing_word_and_open: "(object ( sphere" => "( sphere";
        missing_brace: "(100,75) }" => "(100,75)";
        missing_opening_brace: "{ background" => "background";
        missing_square: "3 [" => "3";
        missing_around_a_tuple: "background (0.8,0.8,0.8)" => "background 0.8,0.8,0.8";
        doubled_open: "( sphere" => "(( sphere";
        doubled_close: "60 0.0 0.0 ))" => "60 0.0 0.0 )))";
        wrong_close: "-150.0) )" => "-150.0) ]";
        wrong_kind: "background (0.8,0.8,0.8)" => "background [0.8,0.8,0.8]";
    }

    tuples {
        missing_comma: "background (0.8,0.8,0.8)" => "background (0.8 0.8 0.8)";
        semicolons: "background (0.8,0.8,0.8)" => "background (0.8; 0.8; 0.8)";
        doubled_comma: "background (0.8,0.8,0.8)" => "background (0.8,,0.8,0.8)";
        trailing_comma: "background (0.8,0.8,0.8)" => "background (0.8,0.8,0.8,)";
        too_few: "background (0.8,0.8,0.8)" => "background (0.8,0.8)";
        too_many: "background (0.8,0.8,0.8)" => "background (0.8,0.8,0.8,1.0)";
        one_number: "background (0.8,0.8,0.8)" => "background 0.8";
        missing: "sphere 40.0 (0.0,0.0,-150.0)" => "sphere 40.0";
        missing_component: "(0.0,0.0,-150.0)" => "(0.0,,-150.0)";
        plane_of_three: "(0.0,1.0,0.0,50.0)" => "(0.0,1.0,0.0) 50.0";
    }

    positions {
        missing_number: "0.3 60 0.0 0.0" => "0.3 60 0.0";
        missing_first_number: "0.3 60 0.0 0.0" => "60 0.0 0.0";
        superfluous_number: "0.3 60 0.0 0.0" => "0.3 60 0.0 0.0 1.0";
        missing_radius: "sphere 40.0" => "sphere";
        centre_before_radius: "sphere 40.0 (0.0,0.0,-150.0)" => "sphere (0.0,0.0,-150.0) 40.0";
        missing_depth: ") 3 [" => ") [";
        comma_between_objects: "0.3 60 0.0 0.0 ))" => "0.3 60 0.0 0.0 )),";
        words_between_objects: "0.3 60 0.0 0.0 ))" => "0.3 60 0.0 0.0 )) and also";
        nonsense: "sphere 40.0 (0.0,0.0,-150.0)" => "3 ] ( , ball [ - @ 7.5 } of fire )";
    }

    characters {
        unknown: "sphere 40.0" => "sphere @40.0";
        invisible: "sphere 40.0" => "sphere \u{200b}40.0";
        quotes: "( sphere" => "( \"sphere\"";
        line_comment: "{ background" => "// the sky\n      { background";
        comments_of_all_kinds: "{ background" => "# sky\n-- sky\n{- more\nsky -} { background";
    }

    sections {
        no_camera: "{ camera (0.0,0.0,150.0) (100,75) }\n      " => "";
        no_background: "      { background (0.8,0.8,0.8) }\n" => "";
        wrong_order: "{ camera (0.0,0.0,150.0) (100,75) }\n      { background (0.8,0.8,0.8) }"
            => "{ background (0.8,0.8,0.8) }\n      { camera (0.0,0.0,150.0) (100,75) }";
        second_camera: "{ background" => "{ camera (0.0,0.0,1.0) (4,3) }\n      { background";
        lights_among_objects: " }\n      { lights\n" => "\n";
        no_header: "renderDescr ( resolution (400,300) ) 3 [\n" => "";
        no_resolution_word: "( resolution (400,300) )" => "(400,300)";
        text_before: "renderDescr" => "my scene: renderDescr";
        text_after: " } ]\n" => " } ]\nthe end";
        bracket_after: " } ]\n" => " } ] ]\n";
    }

    ranges {
        no_pixels: "(400,300)" => "(0,300)";
        too_many_pixels: "(400,300)" => "(2000000000,2000000000)";
        depth_too_low: ") 3 [" => ") -2 [";
        depth_too_high: ") 3 [" => ") 10001 [";
        negative_octaves: "10 64.0" => "-1 64.0";
        too_many_octaves: "10 64.0" => "5000000000 64.0";
    }

    several {
        independent: "sphere 40.0 (0.0,0.0,-150.0) )\n          ( texture ( diff solid (0.8,0.2,0.2) ) 0.3 60"
            => "spere 40 (0.0,0.0,-150.0) \n          ( texture ( dif solid (0.8;0.2,0.2) ) 0.3 60.0";
    }
}

#[test]
fn too_many_errors_end_with_a_note() {
    let source = broken("(ambientLight (0.1,0.1,0.1))", &"(ambientlight (0.1,0.1,0.1))\n".repeat(30));
    let text = shown(source.as_bytes());
    assert_eq!(text.matches("error[unknown-word]").count(), 20);
    assert_eq!(text.matches("too many errors: the rest is not read after 20 of them").count(), 1);
}

#[test]
fn unfinished() {
    for (name, end) in [
        ("in a header", "(400"),
        ("in a section", "{ background (0.8,"),
        ("in an object", "0.3 60"),
        ("between objects", "0.3 60 0.0 0.0 ))"),
        ("in a light", "(0.1,0.1,0.1)"),
        ("between lights", "(0.7,0.7,0.7))"),
        ("before the end", "(0.1,0.1,0.1)) }"),
    ] {
        let end = SCENE.find(end).unwrap() + end.len();
        assert_snapshot!(format!("unfinished-{}", name.replace(' ', "_")), shown(&SCENE.as_bytes()[..end]));
    }
}

#[test]
fn no_scene() {
    for (name, bytes) in [
        ("empty", &b""[..]),
        ("blank", b" \n\t\n"),
        ("prose", b"Once upon a time there was a scene."),
        ("json", b"{ \"camera\": { \"eye\": [0, 0, 150] } }"),
        ("picture", b"P3\n400 300\n255\n"),
        ("nested", &[b'('; 1000]),
        ("latin1", b"renderDescr ( r\xE9solution (400,300) ) 3 ["),
        ("utf16", b"\xFF\xFEr\0e\0n\0d\0e\0r\0"),
        ("binary", b"\x7FELF\x02\x01\x01\x00\x00\x80"),
    ] {
        assert_snapshot!(format!("no_scene-{name}"), shown(bytes));
    }
}
