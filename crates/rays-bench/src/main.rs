//! `rays-bench`: the benchmark of [`rays_bench`] on the command line.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "it talks to the person who runs it")]

use clap::Parser;
use rays_bench::embree::Embree;
use rays_bench::measure::{Clock, Contestant, Role, measure, median};
use rays_bench::meshes::{Mesh, MeshName, TERRAIN_CELLS, bunny, terrain};
use rays_bench::rays::{Kind, Rays};
use rays_bench::{Result, ours, report};
use std::path::PathBuf;
use std::process::ExitCode;

const NO_RIVAL: &str =
    "Without Embree there is nothing to compare with. It comes inside the wheel embreex 4.4.0.post1 of
the Python Package Index: unpack that and set HRAY_EMBREE to its folder embreex.libs.";

/// Times single rays against large triangle meshes, beside Embree where it is at hand.
#[derive(Parser)]
struct Arguments {
    /// The meshes to trace against.
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = [MeshName::Bunny, MeshName::Split, MeshName::Terrain])]
    meshes: Vec<MeshName>,
    /// How many threads build and trace.
    #[arg(long, value_delimiter = ',', default_values_t = [1, 2])]
    threads: Vec<usize>,
    /// Interleaved runs of each tracer, of which the median is shown.
    #[arg(long, default_value_t = 5)]
    runs: usize,
    /// How often each tracer is built, in turn; the median of the times is shown.
    #[arg(long, default_value_t = 1)]
    builds: usize,
    /// The clock by which building and tracing are timed; `cpu` where other work disturbs the machine.
    #[arg(long, value_enum, default_value_t = Clock::Wall)]
    clock: Clock,
    /// The kinds of rays.
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = Kind::ALL)]
    only: Vec<Kind>,
    /// The bunny, an OBJ file or one packed with gzip. Without this, HRAY_PEERS names the folder that holds
    /// models/stanford-bunny.obj.gz.
    #[arg(long)]
    bunny: Option<PathBuf>,
    /// Embree 4's shared library, or the folder that it is in.
    #[arg(long, env = "HRAY_EMBREE")]
    embree: Option<PathBuf>,
}

impl Arguments {
    fn mesh(&self, name: MeshName) -> Result<Mesh> {
        if name == MeshName::Terrain {
            return Ok(terrain(TERRAIN_CELLS));
        }
        let peers = || {
            let folder = std::env::var_os("HRAY_PEERS")?;
            Some(PathBuf::from(folder).join("models/stanford-bunny.obj.gz"))
        };
        let path = self.bunny.clone().or_else(peers);
        let path = path.ok_or("the bunny is not at hand: give --bunny FILE, or set HRAY_PEERS")?;
        let mesh = bunny(&path)?;
        Ok(if name == MeshName::Split { Mesh { name, ..mesh.split().split() } } else { mesh })
    }
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<()> {
    if arguments.runs == 0 || arguments.builds == 0 || arguments.threads.contains(&0) {
        return Err("there must be a run at least, a build, and a thread".into());
    }
    let clock = arguments.clock;
    let embree = arguments.embree.as_deref().map(Embree::load).transpose()?;
    match embree {
        Some(embree) => println!("Embree {}", embree.version()?),
        None => println!("{NO_RIVAL}"),
    }
    for &name in &arguments.meshes {
        let mesh = match arguments.mesh(name) {
            Ok(mesh) => mesh,
            Err(message) => {
                println!("\n{name:?} is left out: {message}");
                continue;
            }
        };
        let mut rays = None;
        for &threads in &arguments.threads {
            let build = || -> Result<Vec<Contestant>> {
                let mut all = embree.map_or(Ok(Vec::new()), |embree| embree.build(&mesh, threads, clock))?;
                all.extend(ours::build(&mesh, threads, clock)?);
                Ok(all)
            };
            let mut contestants = build()?;
            let mut times: Vec<Vec<f64>> =
                contestants.iter().map(|contestant| vec![contestant.build]).collect();
            for _ in 1..arguments.builds {
                for (times, contestant) in times.iter_mut().zip(build()?) {
                    times.push(contestant.build);
                }
            }
            for (contestant, times) in contestants.iter_mut().zip(times) {
                contestant.build = median(times);
            }
            let Some(first) = reference(&contestants) else {
                return Err("There is nobody to trace rays.".into());
            };
            let rays = rays.get_or_insert_with(|| Rays::new(&mesh, |primary| first.tracer.hits(primary)));
            let kinds = arguments.only.iter();
            let results = kinds
                .map(|&kind| (kind, measure(&contestants, rays, kind, threads, arguments.runs, clock)))
                .collect();
            print!("\n{}", report::tables(&mesh, threads, arguments.runs, &contestants, &results));
        }
    }
    Ok(())
}

/// Whose primary hits other rays start from: those of the default rival, which the expected counts are about, or else
/// our own.
fn reference(contestants: &[Contestant]) -> Option<&Contestant> {
    contestants.iter().find(|contestant| contestant.role == Role::Default).or(contestants.first())
}
