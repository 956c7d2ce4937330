#![allow(warnings)]
use hray_lang::hry::{Program, assets::*, eval::*};
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let out = std::env::args().nth(2);
    let text = std::fs::read_to_string(&path).unwrap();
    let t0 = std::time::Instant::now();
    let mut d = vec![];
    let p = Program::load(&path, "scene.hry", text.as_str().into(), &[], &NoAssets, &mut d);
    let c = hray_lang::hry::types::check(&p, &mut d);
    for d in &d {
        println!(
            "{:?} {} {} | {:?}",
            d.code,
            d.message,
            d.primary.text,
            p.sources.location(d.primary.span.start)
        );
    }
    let t1 = std::time::Instant::now();
    let e = evaluate(&p, &NoAssets, 0.0, &Limits::default());
    println!("load {:?} evaluate {:?}", t1 - t0, t1.elapsed());
    for d in &e.diagnostics {
        println!(
            "{:?} {} {} {:?} | {:?}",
            d.code,
            d.message,
            d.primary.text,
            d.notes,
            p.sources.location(d.primary.span.start)
        );
    }
    if let (Some(desc), Some(out)) = (e.description, out) {
        println!("{} primitives", desc.scene.primitives.len());
        let t = std::time::Instant::now();
        hray::render_to_file(&desc, &hray::Options::default(), out, &hray::Control::new()).unwrap();
        println!("render {:?}", t.elapsed());
    }
}
