//! The plume once more, as plainly as its laws can be written: every filament at every small step, true Gaussians, a sum over
//! all filaments for each reading. It shares no code with the simulator's but the random numbers.

use albacore_geometry::math::{exp, ln};
use albacore_sim::{Meander, Noise, Stream};

/// One step of flow and plume, s.
const STEP_S: f64 = 1.0;

/// Its field is as fine as may be: the simulator's has cells twice as wide.
const CELL_M: f64 = 20.0;

/// The numbers of a flat plume in a rectangle along the flow, all SI.
#[derive(Clone, Copy)]
pub struct Law {
    pub length: f64,
    pub width: f64,
    pub speed: f64,
    pub meander_sigma: f64,
    pub bandwidth: f64,
    pub damping: f64,
    pub viscosity: f64,
    pub cell: f64,
    pub source: [f64; 2],
    pub rate: f64,
    pub diffusivity: f64,
    pub initial_radius: f64,
    pub growth: f64,
    pub peak: f64,
    pub peak_age: f64,
}

/// Draws one after the other.
struct Draws(Noise, u64);

pub struct Brute {
    law: Law,
    draws: Draws,
    corners: [[f64; 2]; 8],
    /// Along and across, at (column, row).
    nodes: Vec<Vec<[f64; 2]>>,
    filaments: Vec<Puff>,
    time: f64,
    next_release: f64,
}

#[derive(Clone, Copy)]
struct Puff {
    x: f64,
    y: f64,
    birth: f64,
}

impl Draws {
    fn gaussian(&mut self) -> f64 {
        self.1 += 1;
        self.0.gaussian(self.1)
    }

    fn waiting(&mut self, rate: f64) -> f64 {
        self.1 += 1;
        -ln(1.0 - self.0.uniform(self.1)) / rate
    }
}

impl Brute {
    /// An empty plume in a flow that has forgotten its start.
    pub fn new(law: Law, seed: u64) -> Self {
        let mut draws = Draws(Noise::new(seed, Stream::FlowCorners), 0);
        let (columns, rows) = ((law.length / law.cell).round() as usize, (law.width / law.cell).round() as usize);
        let (sigma, w) = (law.meander_sigma, law.bandwidth);
        let corners = [(); 8].map(|()| [sigma * draws.gaussian(), sigma * w * draws.gaussian()]);
        let nodes = vec![vec![[law.speed, 0.0]; rows + 1]; columns + 1];
        let mut brute =
            Brute { law, draws, corners, nodes, filaments: Vec::new(), time: 0.0, next_release: f64::INFINITY };
        brute.advance(law.length / law.speed);
        brute.next_release = brute.time + brute.draws.waiting(law.rate);
        brute
    }

    /// Lets some seconds go by.
    pub fn advance(&mut self, seconds: f64) {
        for _ in 0..(seconds / STEP_S).round() as u64 {
            self.move_filaments();
            self.move_corners();
            self.move_water();
        }
    }

    /// x'' + 2 zeta w x' + w^2 x = sigma sqrt(4 zeta w^3) n(t): its stationary deviation is sigma.
    fn move_corners(&mut self) {
        let Law { bandwidth: w, damping, meander_sigma: sigma, .. } = self.law;
        let push = sigma * (4.0 * damping * w * w * w * STEP_S).sqrt();
        for [x, rate] in &mut self.corners {
            *rate += -(2.0 * damping * w * *rate + w * w * *x) * STEP_S + push * self.draws.gaussian();
            *x += *rate * STEP_S;
        }
    }

    /// du/dt = -(u u_x + v u_y) + k/2 (u_xx + u_yy); on the edges linear between the corners.
    fn move_water(&mut self) {
        let law = self.law;
        let (last_i, last_j) = (self.nodes.len() - 1, self.nodes[0].len() - 1);
        let (dx, dy) = (law.length / last_i as f64, law.width / last_j as f64);
        let old = self.nodes.clone();
        for i in 0..=last_i {
            for j in 0..=last_j {
                if i == 0 || j == 0 || i == last_i || j == last_j {
                    let (p, q) = (i as f64 / last_i as f64, j as f64 / last_j as f64);
                    let at = |component: usize| {
                        let corner = |c: usize| self.corners[2 * c + component][0];
                        let (near, far) =
                            (corner(0) * (1.0 - p) + corner(1) * p, corner(2) * (1.0 - p) + corner(3) * p);
                        near * (1.0 - q) + far * q
                    };
                    self.nodes[i][j] = [law.speed + at(0), at(1)];
                    continue;
                }
                let [u, v] = old[i][j];
                self.nodes[i][j] = std::array::from_fn(|c| {
                    let (west, east) = (old[i - 1][j][c], old[i + 1][j][c]);
                    let (near, far) = (old[i][j - 1][c], old[i][j + 1][c]);
                    let here = old[i][j][c];
                    let carried = u * (east - west) / (2.0 * dx) + v * (far - near) / (2.0 * dy);
                    let spread = (east - 2.0 * here + west) / (dx * dx) + (far - 2.0 * here + near) / (dy * dy);
                    here + STEP_S * (0.5 * law.viscosity * spread - carried)
                });
            }
        }
    }

    fn velocity(&self, x: f64, y: f64) -> [f64; 2] {
        let (last_i, last_j) = (self.nodes.len() - 1, self.nodes[0].len() - 1);
        let (a, b) = (x / self.law.length * last_i as f64, y / self.law.width * last_j as f64);
        let (i, j) = ((a as usize).min(last_i - 1), (b as usize).min(last_j - 1));
        let (p, q) = (a - i as f64, b - j as f64);
        std::array::from_fn(|c| {
            let along = |j: usize| self.nodes[i][j][c] * (1.0 - p) + self.nodes[i + 1][j][c] * p;
            along(j) * (1.0 - q) + along(j + 1) * q
        })
    }

    fn move_filaments(&mut self) {
        let end = self.time + STEP_S;
        let released = self.filaments.len();
        while self.next_release < end {
            let [x, y] = self.law.source;
            self.filaments.push(Puff { x, y, birth: self.next_release });
            self.next_release += self.draws.waiting(self.law.rate);
        }
        for k in 0..self.filaments.len() {
            let f = self.filaments[k];
            let dt = if k < released { STEP_S } else { end - f.birth };
            let [u, v] = self.velocity(f.x, f.y);
            let spread = (2.0 * self.law.diffusivity * dt).sqrt();
            self.filaments[k].x += u * dt + spread * self.draws.gaussian();
            self.filaments[k].y += v * dt + spread * self.draws.gaussian();
        }
        let (length, width) = (self.law.length, self.law.width);
        self.filaments.retain(|f| (0.0..=length).contains(&f.x) && (0.0..=width).contains(&f.y));
        self.time = end;
    }

    /// Where the filaments are, down-flow and to the right of the corner.
    pub fn filaments(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.filaments.iter().map(|f| (f.x, f.y))
    }

    /// The reading at a place, ratio of full scale.
    pub fn concentration(&self, x: f64, y: f64) -> f64 {
        let law = &self.law;
        let squared_radius = |age: f64| law.initial_radius * law.initial_radius + law.growth * age;
        let reference = squared_radius(law.peak_age);
        let mut sum = 0.0;
        for f in &self.filaments {
            let r2 = squared_radius(self.time - f.birth);
            let d2 = (f.x - x) * (f.x - x) + (f.y - y) * (f.y - y);
            // Less than 1e-10 of its peak.
            if d2 < 50.0 * r2 {
                sum += law.peak * reference / r2 * exp(-d2 / (2.0 * r2));
            }
        }
        sum
    }
}

impl Law {
    /// The meander's numbers in this law.
    pub fn with_meander(self, meander: &Meander, bandwidth: f64) -> Self {
        Law {
            meander_sigma: meander.direction_sd * self.speed,
            bandwidth,
            damping: meander.damping,
            viscosity: meander.viscosity,
            cell: CELL_M,
            ..self
        }
    }
}
