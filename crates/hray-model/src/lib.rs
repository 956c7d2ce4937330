//! The executable specification of hray: every definition of K. Hoste's thesis of 2005, one function each.
//!
//! The thesis gives its ray tracer twice: as a formal model in Funmath (chapter 2) and as a Haskell program
//! (chapter 3, in full in appendix A). This crate is that model as something one can run, so that "the engine
//! does what the thesis says" is a comparison and not an opinion. It is slow and obvious on purpose: tuples of
//! `f64`, lists, recursion, and no dependency but `libm`.
//!
//! # How to read it
//!
//! The modules follow the thesis in its own order, and so does each module inside:
//!
//! | module | thesis | holds |
//! |---|---|---|
//! | [`concepts`] | §2.3.1 | points, rays, objects, lights, scenes, images |
//! | [`helpers`] | §2.3.2, helper functions | the accessors `start`, `rad`, `normalAt`, ... |
//! | [`maths`] | §2.3.2, mathematical basis; A.1 | from `len` to `mapToWin` |
//! | [`engine`] | §2.3.2, core of the algorithm; A.2 | from `fstPos` to `rayTrace` |
//! | [`mod@perlin`] | §3.4; A.3 | noise and the eight patterns made of it |
//! | [`output`] | §3.5; A.4 | `getImage` and `createPPM` |
//!
//! A name `intRayWith` of the thesis is `int_ray_with` here; only `mkRay'` has no such spelling and is called
//! [`mk_ray_dir`]. Everything is exported at the root of the crate. The documentation of a function gives its
//! Funmath definition and, where that differs, its Haskell; **the code is always the Haskell**, because the
//! pictures of 2005 came from it.
//!
//! # Notation
//!
//! Funmath's marks are written on the line:
//!
//! | here | in the thesis | meaning |
//! |---|---|---|
//! | `+^`, `-^`, `·^` | a hat over the operator | direct extension: component by component |
//! | `v ·→ a` | an arrow over the operator | half-direct extension: every component with `a` |
//! | `v • w` | the same | scalar product |
//! | `c ? a † b` | the same | if c then a else b |
//! | `f ⟶[e] x` | an arrow with index e | left fold of the list x from e |
//! | `x ≻ xs`, `ε` | the same | a list with first element x; the empty list, no intersection |
//! | `□ n` | the same | the numbers 0, ..., n - 1 |
//! | `S ∋ r → T` | the same | a dependent type: T may mention the argument r |
//! | `t 0` | the same | the first component of the tuple t |
//!
//! # What the code promises
//!
//! Arithmetic is IEEE 754 binary64 in exactly the order in which the Haskell writes it: nothing is fused or
//! re-associated. Sine and `**` come from `libm`. Infinite and NaN values take the course they take in a
//! program compiled by GHC for x86-64; where that needs a thought the function concerned says so. No function
//! panics. Two things never ended in 2005: a recursion depth below -1, which is [`EndlessRecursion`] here, and
//! a negative octave count, which the type `u64` rules out. The recursion is real recursion: a level takes
//! about a kilobyte of stack, so 10 000 levels between facing mirrors want a thread with a larger one.
//!
//! A [`Scene`] keeps objects and lights in the order in which they are written. The parser of 2005 built both
//! lists reversed; [`intersect`] and [`color_pt`], which consume them, do that reversal.

pub mod concepts;
pub mod engine;
pub mod helpers;
pub mod maths;
pub mod output;
pub mod perlin;

pub use concepts::*;
pub use engine::*;
pub use helpers::*;
pub use maths::*;
pub use output::*;
pub use perlin::*;
