//! Interior vertices moved to where their triangles are even.

use glam::DVec2;

/// Moves each vertex from `first` on to the area-weighted mean of its triangles' centroids, one after the other, `rounds`
/// times (the centroidal patch step of Chen and Holst, "Efficient mesh optimization schemes based on optimal Delaunay
/// triangulations", 2011). No triangle is turned over.
pub(super) fn smooth(points: &mut [DVec2], triangles: &[[u32; 3]], first: usize, rounds: usize) {
    let around = Around::new(points.len(), triangles);
    for _ in 0..rounds {
        for vertex in first..points.len() {
            let own = around.of(vertex);
            let mut mean = DVec2::ZERO;
            let mut weight = 0.0;
            for &triangle in own {
                let corners = triangles[triangle as usize].map(|v| points[v as usize]);
                let area = doubled_area(corners);
                mean += area * (corners[0] + corners[1] + corners[2]) / 3.0;
                weight += area;
            }
            if weight <= 0.0 {
                continue;
            }
            let before = points[vertex];
            points[vertex] = mean / weight;
            let least = 1e-3 * weight / own.len() as f64;
            if own.iter().any(|&t| doubled_area(triangles[t as usize].map(|v| points[v as usize])) <= least) {
                points[vertex] = before;
            }
        }
    }
}

/// Twice the area of a triangle; negative where it is clockwise.
pub(super) fn doubled_area([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The triangles around every vertex.
struct Around {
    starts: Vec<u32>,
    triangles: Vec<u32>,
}

impl Around {
    fn new(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let mut starts = vec![0u32; vertices + 1];
        for corner in triangles.iter().flatten() {
            starts[*corner as usize + 1] += 1;
        }
        for i in 0..vertices {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut sorted = vec![0u32; triangles.len() * 3];
        for (i, triangle) in triangles.iter().enumerate() {
            for &corner in triangle {
                sorted[next[corner as usize] as usize] = i as u32;
                next[corner as usize] += 1;
            }
        }
        Self { starts, triangles: sorted }
    }

    fn of(&self, vertex: usize) -> &[u32] {
        &self.triangles[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}
