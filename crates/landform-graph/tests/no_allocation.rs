//! An agent may search a graph of a million nodes as often as it likes: once the memory of a
//! search fits the lattice and its front, searching allocates nothing.

#![allow(unsafe_code, reason = "only an allocator can count allocations")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::hint::black_box;
use std::ops::ControlFlow;

use landform_graph::marching::{FastMarching, Front, MarchOptions, Relaxation, Speed};
use landform_graph::{Boundary, BreadthFirst, Connectivity, Edge, Lattice, Reach, Visit};

/// The system's allocator, which counts what the present thread asks for.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations during `work`.
fn allocations(work: impl FnOnce()) -> u64 {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

/// A plane and a volume of about a million nodes.
fn million_nodes() -> [Lattice; 2] {
    [
        Lattice::plane([1024; 2], 1.0, Connectivity::FourEight, [Boundary::Open; 2]),
        Lattice::volume([100; 3], 1.0, Connectivity::Voxel26, [Boundary::Periodic; 3]),
    ]
    .map(|lattice| lattice.expect("a lattice"))
}

/// Memory of searches of every kind, and a field that they lower.
struct Searches {
    breadth_first: BreadthFirst,
    marching: FastMarching,
    front: Front,
    relaxation: Relaxation,
    pressure: Vec<f64>,
}

impl Searches {
    fn new(lattice: &Lattice) -> Self {
        Self {
            breadth_first: BreadthFirst::new(),
            marching: FastMarching::new(),
            front: Front::new(),
            relaxation: Relaxation::new(),
            pressure: vec![100.0; lattice.node_count()],
        }
    }

    fn search(&mut self, lattice: &Lattice, node: usize) {
        self.breadth_first(lattice, node);
        self.march(lattice, node);
        self.lower(lattice, node);
        black_box(lattice.neighbours(node).map(|edge| edge.distance).sum::<f64>());
        black_box(lattice.ray(node, 1.0, 50.0).count());
        black_box(lattice.walk(node, Lattice::map_direction(2.0), 50.0).count());
    }

    /// From two sources to a radius, and from one until something is found.
    fn breadth_first(&mut self, lattice: &Lattice, node: usize) {
        let everywhere = |_: usize, _: &Edge| true;
        let search = &mut self.breadth_first;
        let disc = search.collect(lattice, &[node, node + 3], Reach::metres(6.0), everywhere);
        assert!(disc.len() > 100);
        let far = |visit: &Visit| visit.edges == 4;
        assert!(search.find(lattice, &[node], Reach::UNLIMITED, everywhere, far).is_some());
    }

    /// From two sources to a distance, and until something is found.
    fn march(&mut self, lattice: &Lattice, node: usize) {
        let options = MarchOptions { limit: 5.0, ..MarchOptions::default() };
        let near = self.marching.distance(lattice, &[node, node + 3], options);
        assert!(near.is_ok_and(|near| near.order.len() > 50));
        let starts = [(node, 0.0), (node + 3, 1.0)];
        let far = |_, time| match time > 3.0 {
            true => ControlFlow::Break(time),
            false => ControlFlow::Continue(()),
        };
        let unlimited = MarchOptions::default();
        let found = self.marching.search(lattice, Speed::Uniform(1.0), &starts, unlimited, far);
        assert!(found.is_ok_and(|found| found.is_some()));
    }

    /// Lowers the pressure around a node, first by a front, then further by relaxation.
    fn lower(&mut self, lattice: &Lattice, node: usize) {
        let pressure = &mut self.pressure;
        pressure[node] = 96.0;
        let lowered = self.front.march(lattice, &[(node, 0.0)], |from, edge| {
            let through = pressure[from] + edge.distance;
            (through < pressure[edge.node]).then(|| {
                pressure[edge.node] = through;
                through
            })
        });
        assert!(lowered.is_ok_and(|taken| taken > 10));
        pressure[node] = 95.0;
        let cost = |_, edge: &Edge| edge.distance;
        let relaxed = self.relaxation.relax(lattice, pressure, &[node], 2.0, cost);
        assert!(relaxed.is_ok_and(|taken| taken > 10));
    }
}

#[test]
fn searches_on_a_million_nodes_allocate_nothing() {
    for lattice in million_nodes() {
        let mut searches = Searches::new(&lattice);
        let nodes = || (0..60).map(|number| 50_000 + 15_013 * number);
        let first = allocations(|| nodes().for_each(|node| searches.search(&lattice, node)));
        assert!(first > 0, "memory is taken at first");
        // The pressure as it was before, so that fronts are as wide.
        searches.pressure.fill(100.0);
        let again = allocations(|| nodes().for_each(|node| searches.search(&lattice, node)));
        assert_eq!(again, 0, "on {:?}", lattice.connectivity());
    }
}
