//! What a user sees of every kind of mistake in names and types. The snapshots are to be read as by someone who has
//! never seen the language: what was found, what was expected and why, how to mend it.

use crate::common::{errors, shown};
use insta::assert_snapshot;

/// The mistakes of one kind: each a name and a text beside a scene.
macro_rules! mistakes {
    ($($kind:ident { $($name:ident: $text:literal;)+ })+) => {$(
        #[test]
        fn $kind() {
            $(assert_snapshot!(concat!(stringify!($kind), "-", stringify!($name)), errors($text));)+
        }
    )+};
}

mistakes! {
    names {
        misspelt: "a = [shpere { radius = 1 }, sphere { radius = trun }]";
        lerp: "a = lerp white black 0.5";
        vec3: "a = vec3(1, 2, 3)";
        pigment: "a = pigment { color = white }";
        color_rgb: "a = color (rgb 1 0 0)";
        pow: "a = pow 2 3";
        len: "a = len [1, 2]";
        null: "a = null";
        radians: "a = sin (radians 30)";
        nowhere: "a = thickness * 2";
        field_alone: "a = radius * 2";
        several: "a = foo + bar\nb = a + 1\nc = baz";
        bound_twice: "f x x = x";
        local_misspelt: "f width = let height = widht * 2 in height";
        hit_of_a_field: "a = classic { color = white * h.p.y + gold * h.p.x, reflection = h.p.x }";
        hit_of_bumps: "a = classic { bump = 0.1 * sin h.p.x }";
        hit_of_nothing: "a = sphere { radius = h.p.x }\nb = classic { color = \\p -> h.p.x }";
        unknown_type: "f : Float -> Number\nf x = x";
    }

    newcomers {
        unit_apart: "a = sphere {} |> rotate up 30 deg";
        degrees: "a = sphere {} |> rotate up 30\nb = sin -45 + cos 3\nc = hsl 120 1 0.5";
        percent: "a = hsl 120deg 100 50";
        bytes: "a = rgb 255 128 0\nb = rgb 2 2 2";
        haskell_dot: "a = (sqrt . abs) 2";
        parentheses_for_braces: "a = sphere (radius = 1, center = (0, 1, 0))\nb = cube(size: 2)";
        group_with_commas: "a = group sphere {}, cube {}";
        group_of_two: "a = group (sphere {}) (cube {})";
        difference_of_a_list: "a = difference [sphere {}, cube {}]\nb = union [sphere {}, cube {}, plane {}]";
        call_in_a_call: "ball r s = sphere { radius = r * s }\na = ball sin 3 2";
        three_numbers: "a = sphere { center = 1 2 3 }\nb = sphere { center = 0 -1 2 }";
        number_before_shape: "a = 1 sphere { radius = 2 }";
        question: "a = sphere { radius = 1 > 2 ? 3 : 4 }";
        minus_apart: "ball x c = sphere { center = (x, 0, 0), material = classic { color = c } }\na = ball - 1.6 white\nb = ball 1 - 2";
        quote_not_closed: "a = { file = \"a.png, list = [1, (2)] }\nb = 1";
        no_such_shape: "a = blob { radius = 1 }\nb = prism {}";
        no_such_camera: "a = fisheye { fov = 180deg }";
        colors: "a = purple\nb = darkGreen";
        time: "a = sphere {} |> rotate up (turn * time)";
        greek: "a = sphere { radius = π }";
        axis: "a = sphere {} |> rotate y 30deg";
        scale_of_a_vector: "a = sphere {} |> scale (1, 2, 1)";
        stretch_of_a_number: "a = sphere {} |> stretch 2";
        cube_of_a_vector: "a = cube { size = (1, 2, 1) }";
        box_of_a_number: "a = box { size = 2 }";
        one_argument_less: "a = classic { color = rgb 1 0 }\nb = classic { color = ramp [#ff0000, #0000ff] }";
        method: "a = sphere {}.translate (0, 1, 0)";
        pipe_missing: "a = sphere {} |> translate (0, 1, 0) rotate up 30deg";
        hides_the_library: "sphere r = sphere { radius = r }\na = sphere 2";
        fields_without_names: "a = sphere { (0, 1, 0), 2 }";
        compared_field: "a = sphere { radius == 1 }";
        part_of_a_field: "a = sphere { center.x = 1 }";
        vector_as_list: "a = sphere { center = [0, 1, 0] }";
        vector_as_record: "a = sphere { center = { x = 1, y = 2, z = 3 } }";
        index: "v = [1, 2]\na = v[0] + v[count v - 1]";
        record_for_values: "ball r = sphere { radius = r }\na = ball { r = 1 }";
        python: "a = [ sphere { radius = i } | i <- [1 .. 3] ]\nb = [ sphere { radius = i } for i in range(10) ]";
        javascript: "const ball = (r) => sphere { radius = r }\na = ball (Math.sqrt 2)";
        def: "def ball(r) = sphere { radius = r }\na = ball 2";
        grey_in_mix: "red = #ff0000\na = mix 0 red 0.5";
    }

    habits {
        time_of_the_scene: "ball = sphere { center = (0, sin t, 0) }\nmovie t = ball";
        two_minus_signs: "a = 3--2\nb = { radius = 3--2 }\nc = 1 --2 is a comment";
        bytes_divided: "a = rgb 200 100 50 / 255";
        diameter: "a = sphere { diameter = 3 }\nb = classic { roughness = 0.2, specular = 0.5 }";
        part_of_a_record: "a = marble {}\nb = wood { light = brown, dark = black }\nc = tiles white black";
        hit_missing_in_a_body: "a = classic { color = \\h -> checker white black }\nb = classic { color = \\h -> rgb h.p.x }";
        one_branch_varies: "a = classic { color = if 1 > 2 then checker white black else blue }";
        call_of_nothing: "a = random()";
        map_of_a_constructor: "a = map sphere [1, 2, 3]";
        named_argument: "a = sphere {} |> translate (x = 1)";
        part_of_the_place: "f h = if h.x > 0 then red else blue\na = classic { color = f }\nb = classic { color = \\h -> white * (h.y + h.p.x) }";
        constructors_in_a_row: "a = difference cube {} sphere {}\nb = group sphere {} cube {}";
        blocks: "c = 1 > 2\na = if c { red } else { blue }\nf r = { return sphere { radius = r } }";
        function_without_backslash: "a = classic { color = h -> red }";
        generator_with_equals: "a = [ i | i = [0 .. 5] ]\nb = [ i | for i in [0 .. 5] ]\nc = [ i | i <- 0 .. 5 ]";
        comma_missing_before_a_field: "a = sphere { radius = 1 center (0, 0, 0) }";
        composed_at_the_top: "a = sin . cos";
        flat_faces: "a = triangles { points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces = [0, 1, 2] }";
        sides: "a = box { width = 1 }";
        rotate_y: "a = sphere {} |> rotateY 30deg\nb = sphere {} |> rotate (0, 30, 0)";
        two_words: "my ball = sphere {}\na = ball";
        povray_inside: "a = box { <-1, 0, -1>, <1, 2, 1> }\nb = sphere { center = <-1, 0, 0> }\nc = plane { y, -1 }\nd = rgb <1, 0, 0>";
        degree_sign: "a = 30°";
        decimal_comma: "a = sphere { radius = 1,5 }";
        file_for_an_image: "a = classic { color = imageMap \"x.png\" }";
        vector_for_a_color: "a = classic { color = \\h -> h.normal * 0.5 + 0.5 }";
        list_in_parentheses: "a = group (sphere {}, cube {})";
        equals_missing: "s sphere { radius = 1 }";
        pipe_of_a_shell: "a = sphere {} | translate (1, 0, 0)";
    }

    fields {
        of_a_constructor: "a = sphere { radios = 1 }";
        color_of_a_sphere: "a = sphere { color = white }";
        position_of_a_sphere: "a = sphere { position = (0, 1, 0) }";
        of_another: "a = point { position = (0, 1, 0), angle = 1 }";
        missing: "a = point { intensity = 1 }";
        several_missing: "a = spotlight {}";
        twice: "a = sphere { radius = 1, radius = 2 }";
        twice_in_a_record: "a = { x = 1, x = 2 }";
        of_a_record: "r = { width = 1, height = 2 }\na = r.widht";
        of_a_vector: "a = (1, 2).z";
        length_of_a_vector: "v = (1, 2, 3)\na = v.length";
        of_a_color: "a = #ffffff.x";
        of_a_hit: "f h = h.p.x + h.position.x\na = classic { reflection = f }";
        of_a_known_hit: "f : Hit -> Number\nf h = h.position.x";
        of_a_list: "a = [1, 2].length";
        of_a_shape: "a = (sphere {}).radius";
        of_a_number: "n = 1\na = n.x";
        hit_twice: "f h = h.p.w";
        update_of_none: "r = { a = 1 }\nb = { r | c = 2 }";
        update_of_a_vector: "v = (1, 2, 3)\nb = { v | x = 2 }";
        update_of_another_type: "r = { a = 1 }\nb = { r | a = \"x\" }";
        late: "height r = r.size * 2\na = height { siez = 1 }";
        late_constructor: "ball r = sphere r\na = ball { radios = 1 }";
    }

    values_of_fields {
        text_for_a_number: "a = sphere { radius = \"big\" }";
        number_for_a_vector: "a = sphere { center = 1 }";
        two_for_three: "a = sphere { center = (1, 2) }";
        vector_for_a_color: "a = classic { color = (1, 0.5, 0) }";
        color_for_a_vector: "a = sphere { center = white }";
        color_for_a_material: "a = sphere { material = white }";
        texture_for_a_material: "a = sphere { material = checker white black }";
        text_for_a_color: "a = classic { color = \"red\" }";
        not_varying: "a = sphere { radius = \\h -> h.p.x }";
        function_of_a_place: "wave p = white * sin p.x * p.z\na = classic { color = wave }";
        typed_function_of_a_place: "wave : Vec3 -> Color\nwave p = white * p.z\na = classic { color = wave }";
        without_its_size: "tiles : Number -> Hit -> Color\ntiles size h = white * h.p.x / size\na = classic { color = tiles }";
        vector_from_a_texture: "a = classic { color = \\h -> h.p }";
        number_for_a_surface: "a = implicit { function = 0.5 }";
        color_of_a_surface: "a = implicit { function = \\p -> red }";
        surface_of_a_hit: "a = implicit { function = \\h -> length h.p - 1 }";
        surface_without_a_function: "a = implicit { size = (1, 1, 1) }";
        surface_of_three_numbers: "a = implicit { function = \\x y z -> x ^ 2 + y ^ 2 + z ^ 2 - 1 }";
        number_for_bumps: "a = classic { bump = 0.5 }";
        size_of_zero: "a = cube { size = 0 }";
        negative_size: "a = box { size = (1, -1, 2) }";
        degrees_for_radians: "a = perspective { from = (0, 0, 5), fov = 40 }";
        no_direction: "a = directional { direction = (0, 0, 0) }";
    }

    constructors {
        without_braces: "a = sphere 0.5";
        povray: "a = sphere (0, 1, 0) 0.5";
        bare: "a = [sphere {}, cube]";
        bare_light: "f : Light -> Number\nf l = 1\na = f point";
        too_much: "a = sphere { radius = 1 } (0, 1, 0)";
        record_alone: "a = union { radius = 1 } (sphere {})";
        piped: "a = 0.5 |> sphere";
    }

    calls {
        with_commas: "a = mix(white, black, 0.5)";
        with_commas_and_space: "a = atan2 (1, 2)";
        negative_argument: "f n = n + 1\na = let n = 5 in n -1";
        negative_argument_of_a_call: "a = sin 1 -1";
        too_many: "a = sin 1 2";
        too_many_names: "a = sin sqrt 2";
        too_few: "a = 1 + mix 1 2";
        too_few_in_a_list: "ring n shape = [shape | _ <- [1 .. n]]\na = [1] ++ ring 3";
        number_called: "n = 3\na = n 4";
        product: "f x = 2 x";
        wrong_order: "a = translate (sphere {}) (0, 1, 0)";
        number_for_a_vector: "a = sphere {} |> translate 1";
        number_for_a_shape: "a = scale 2 3";
        list_for_a_shape: "balls = [sphere {}]\na = balls |> translate up";
        list_for_a_shape_after: "a = rotate up 30deg [sphere {} | _ <- [1 .. 3]]";
        lights_for_a_light: "lamps = [point { position = up }]\na = lamps |> scale 2";
        vector_without_parentheses: "a = translate 0 -1 0 (sphere {})";
        vector_without_parentheses_piped: "a = sphere {} |> stretch 1 2 1 |> rotate 0 1 0 30deg";
        hit_for_a_place: "f : Hit -> Number\nf h = noise h";
        place_for_a_hit: "f : Hit -> Number\nf h = h.p.x\ng h = f h.p";
        pipe_to_a_value: "a = 1 |> 2";
        compose: "a = show >> sin";
        many_refused: "a = smoothstep \"0\" 1 2";
        commas_of_vectors: "a = dot((1, 2, 3), (4, 5, 6))";
        list_index: "list = [1, 2, 3]\na = list 0";
    }

    operators {
        text_and_number: "a = \"n = \" + 1";
        vectors: "a = (1, 2) + (1, 2, 3)";
        color_and_vector: "a = white * (1, 2, 3)";
        shapes: "a = sphere {} + cube {}";
        lists: "a = [1] + [2]";
        functions: "a = classic { color = checker white black * 0.5 }";
        condition: "a = true * 2";
        power: "a = 2 ^ (1, 2)";
        not_a_condition: "f x = x and 1";
        not_number: "a = not 1";
        ordered_vectors: "a = (1, 2) < (2, 3)";
        compared: "a = 1 == \"1\"";
        compared_functions: "a = sin == cos";
        compared_shapes: "a = sphere {} == sphere {}";
        append_an_element: "a = [1, 2] ++ 3";
        append_to_an_element: "a = sphere {} ++ [cube {}]";
        append_number: "a = \"n = \" ++ 1";
        late: "sum2 a b = a + b\nc = sum2 \"a\" 1";
        late_vectors: "sum2 a b = a + b\nc = sum2 (1, 2) (1, 2, 3)";
    }

    branches {
        condition: "a = if 1 then 2 else 3";
        condition_of_a_vector: "f h = if h.p then 1 else 2";
        differ: "a = if true == false then 1 else \"two\"";
        color_and_number: "f x = if x > 0 then white else 0";
        number_and_color: "f x = if x > 0 then 0.5 else white";
        number_and_color_in_a_match: "f x = match x { 0 -> x, _ -> white }";
        arms: "f x = match x { 0 -> white, 1 -> \"black\", _ -> black }";
        pattern: "f x = match x + 1 { \"a\" -> 1, _ -> 2 }";
        patterns: "f x = match x { 0 -> 1, true -> 2, _ -> 3 }";
        vector_pattern: "f = match (1, 2, 3) { (x, y) -> x + y }";
        missing_bool: "f x = match x { true -> 1 }";
        missing_empty: "f list = match list { [x, ..] -> x }";
        missing_longer: "f list = match list { [] -> 0, [x] -> x }";
        missing_between: "f list = match list { [] -> 0, [_, y, ..] -> y }";
        missing_number: "f x = match x { 0 -> 1, 1 -> 2 }";
    }

    lists {
        mixed: "a = [1, 2, \"three\"]";
        color_among_numbers: "a = [0, 1, #fff]";
        light_among_shapes: "a = [sphere {}, point { position = (0, 1, 0) }]";
        nested: "ring n = [sphere {} | _ <- [1 .. n]]\na = [cube {}, ring 3]";
        range: "a = [0 .. \"3\"]";
        range_of_a_list: "list = [1, 2]\na = [0 .. list]";
        generator: "n = 4\na = [i | i <- n]";
        guard: "a = [i | i <- [1 .. 3], i + 1]";
        component: "a = (1, \"2\", 3)";
        vector_in_a_vector: "v = (1, 2)\na = (v, 3)";
    }

    annotations {
        wrong: "a : Text\na = 1";
        result: "f : Number -> Color\nf x = x * 2";
        not_a_function: "f : Number\nf x = x";
        too_few: "f : Number -> Number\nf a b = a + b";
        too_general: "f : a -> a\nf x = x + 1";
        two_variables: "f : a -> b\nf x = x";
        numerics: "f : numeric -> numeric1 -> numeric\nf a b = a + b";
        inside: "a = (1 : Text)";
        escape: "f x = let g : a -> a\n          g y = x\n      in g 1";
    }

    recursion {
        infinite: "f x = f";
        itself: "f x = x x";
        other_type: "f n = if n == 0 then 1 else f \"x\"";
        result: "f n = if n == 0 then \"end\" else f (n - 1) + 1";
        polymorphic: "f : a -> Number\nf x = f [x]";
    }
}

/// The mistakes of a scene: each a name and a whole file.
macro_rules! scenes {
    ($($name:ident: $text:literal;)+) => {
        #[test]
        fn scenes() {
            $(assert_snapshot!(concat!("scenes-", stringify!($name)), shown($text));)+
        }
    };
}

scenes! {
    none: "ball = sphere {}\n";
    empty: "-- nothing yet\n";
    misspelt: "scen = { objects = [ sphere {} ] }\n";
    main: "main = { objects = [ sphere {} ] }\n";
    a_shape: "scene = sphere {}\n";
    a_list: "scene = [sphere {}, cube {}]\n";
    a_number: "scene = 3\n";
    unknown_field: "scene = { object = [ sphere {} ] }\n";
    one_light: "scene = { light = point { position = (3, 4, 5) }, objects = [] }\n";
    one_object: "scene = { object = sphere {}, lamp = point { position = up } }\n";
    one_shape: "scene = { objects = sphere {} }\n";
    light_in_objects: "scene = { objects = [ sphere {}, point { position = (0, 1, 0) } ] }\n";
    shape_in_lights: "scene = { lights = [ sphere {} ] }\n";
    material_in_objects: "scene = { objects = [ classic {} ] }\n";
    camera_in_objects: "scene = { objects = [ perspective { from = (0, 1, 2) } ] }\n";
    list_in_objects: "ring n = [sphere {} | _ <- [1 .. n]]\nscene = { objects = [ ring 3, cube {} ] }\n";
    shape_after_list: "ring n = [sphere {} | _ <- [1 .. n]]\nscene = { objects = ring 3 ++ cube {} }\n";
    function_in_objects: "ring n = [sphere {} | _ <- [1 .. n]]\nscene = { objects = ring }\n";
    size_of_one: "scene = { size = 800, objects = [] }\n";
    fraction_of_samples: "scene = { samples = 1.5, objects = [] }\n";
    camera_without_braces: "scene = { camera = perspective, objects = [] }\n";
    background_of_a_hit: "scene = { background = \\h -> white * h.p.x, objects = [] }\n";
    misspelt_integrator: "scene = { integrator = whited, encoding = sRGB, objects = [] }\n";
    two_parameters: "scene t s = { objects = [ sphere { radius = t * s } ] }\n";
    text_for_time: "scene t = { objects = [ sphere { radius = t ++ \"x\" } ] }\n";
    through_another: "base = { objects = [], lihgts = [] }\nscene = base\n";
    several: "ball = sphere { radios = 1 }\n\ngold = classic { color = (1, 0.8, 0) }\n\nscene t = {\n  camera = perspective { form = (0, 1, 2) },\n  lights = [ point { position = 3 } ],\n  objects = [ ball |> paint golden, sphere { radius = \"1\" } ],\n}\n";
}
