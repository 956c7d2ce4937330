//! From a scene to the bytes of a picture: module `HRayOutput` of §3.5 and A.4.
//!
//! Its third function, `getRenderTime`, formats the time that the program took. That is no part of what a
//! picture is and has no counterpart here.

use crate::concepts::{Color, Scene};
use crate::engine::{EndlessRecursion, ray_trace};
use crate::perlin::NoiseTables;

/// The colours of a picture, row by row from the top (py = ry - 1) to the bottom, each from left to right.
///
/// ```text
/// A.4      getImage d r@(rx,ry) s = [image (fromIntegral x,fromIntegral (-y))
///                                    | y <- [-(ry-1)..0], x <- [0..(rx-1)]]
///            where image = rayTrace d r s
/// ```
///
/// # Errors
/// [`EndlessRecursion`] where the depth is below -1.
pub fn get_image(
    depth: i64,
    resolution: (i64, i64),
    scene: &Scene,
    tables: &NoiseTables,
) -> Result<Vec<Color>, EndlessRecursion> {
    let image = ray_trace(depth, resolution, scene, tables)?;
    let (columns, rows) = image.domain();
    let mut colors = vec![];
    for py in rows.rev() {
        for px in columns.clone() {
            colors.push((image.color)((px, py)));
        }
    }
    Ok(colors)
}

/// The text of a PPM file (Netpbm's `P3`) for a resolution and as many colours as it has pixels.
///
/// ```text
/// A.4      createPPM (w,h) colors = ("P3\n"++) . shows w . (' ':) . shows h
///                                 . ("\n255\n"++) . stringify colors $ ""
///            where stringify = flip $ foldr showC
///                  showC (r,g,b) = shows (round (r*255)) . (' ':)
///                                . shows (round (g*255)) . (' ':)
///                                . shows (round (b*255)) . (' ':)
/// ```
///
/// There is no line break after the header and none at the end. A component is written whatever its value: 2
/// gives 510, which no reader of the format expects. Where §3.5 shows `(' ')` the scan has lost the colon.
#[must_use]
pub fn create_ppm((w, h): (i64, i64), colors: &[Color]) -> String {
    let mut text = format!("P3\n{w} {h}\n255\n");
    for &(r, g, b) in colors {
        text.push_str(&shows_round(r * 255.0));
        text.push(' ');
        text.push_str(&shows_round(g * 255.0));
        text.push(' ');
        text.push_str(&shows_round(b * 255.0));
        text.push(' ');
    }
    text
}

/// 2¹⁰²⁴, to which GHC rounds infinity.
const TWO_TO_1024: &str = "179769313486231590772930519078902473361797697894230657273430081157732675\
    805500963132708477322407536021120113879871393357658789768814416622492847430639474124377767893424865485276\
    302219601246094119453082952085005768838150682342462881473913110540827237163350510684586298239947245938479\
    716304835356329624224137216";

/// 3 · 2¹⁰²³, to whose negative GHC rounds the NaN that x86-64 computes.
const THREE_TIMES_TWO_TO_1023: &str = "269653970229347386159395778618353710042696546841345985910145\
    121736599013708251444699062715983611304031680170819807090036488184653221624933739271145959211186566651840\
    137298227914453329401869141179179624428127508653257226023513694322210869665811240855745025766026879447359\
    920868907719574457253034494436336205824";

/// `show (round x :: Integer)`: the nearest whole number, the even one of two, in full. There is no negative
/// zero among the whole numbers. Infinity and NaN, which GHC takes for the numbers that their bits would be
/// without their special meaning, cannot come from a finite scene.
fn shows_round(x: f64) -> String {
    if x.is_nan() {
        format!("-{THREE_TIMES_TWO_TO_1023}")
    } else if x.is_infinite() {
        let sign = if x < 0.0 { "-" } else { "" };
        format!("{sign}{TWO_TO_1024}")
    } else {
        // Rounded, then with no digits behind the point: the formatter writes every digit before it exactly.
        // The added 0 makes a positive zero of a negative one.
        format!("{:.0}", x.round_ties_even() + 0.0)
    }
}
