//! Simulation of a falling cloth by position-based dynamics.
//!
//! Each step moves all vertices by their velocities and gravity, corrects distances along and across threads,
//! moves vertices that are inside the ball or below the ground back onto the surfaces with Coulomb friction,
//! and derives the velocities from the change of the positions (M. Macklin et al., "Small Steps in Physics
//! Simulation", 2019). There are many small steps with one correction each. All arithmetic is f64 in a fixed
//! order with operations that IEEE 754 rounds exactly, so that every machine gets the same bits.

use glam::DVec3;

/// Radius of the ball, metres; the ball lies on the ground.
pub(super) const RADIUS: f64 = 0.45;
/// Centre of the ball, metres, above the ground.
pub(super) const MIDDLE: DVec3 = DVec3::new(0.0, RADIUS + 0.002, 0.0);
/// Side of the cloth, metres.
pub(super) const SIDE: f64 = 2.3;
/// Height from which the cloth falls, metres.
const START: f64 = 1.12;
/// Position of the cloth's centre over the ground, metres: not exactly over the ball.
const OFFSET: (f64, f64) = (0.06, -0.04);
/// Cosine and sine of the angle by which the cloth is turned.
const TURN: (f64, f64) = (0.96, 0.28);
/// Half thickness of the cloth, metres, which is kept between the cloth and everything else.
const CLEARANCE: f64 = 0.004;

/// Acceleration of gravity, m/s^2.
const GRAVITY: f64 = 9.81;
/// Damping of velocities by air, 1/s.
const DRAG: f64 = 0.6;
/// Share of a velocity difference between neighbours that one step removes: friction of the threads.
const THREADS: f64 = 0.08;
/// Coefficients of friction on the ball and on the ground.
const FRICTION: (f64, f64) = (0.35, 0.7);
/// Rates at which deviations of lengths are corrected, 1/s: of diagonals, and of the distances that resist
/// bending.
const SHEAR: f64 = 500.0;
const BEND: f64 = 160.0;
/// Length over which the cloth resists bending, metres.
const BEND_SPAN: f64 = 0.075;
/// Steps per second for coarse cloth; fine cloth takes a multiple.
const STEPS: u64 = 1200;
/// Number of squares along a side for which [`STEPS`] suffices.
const SQUARES: u64 = 240;

/// Cloth after a number of steps.
#[derive(Clone, Debug)]
pub(super) struct Simulation {
    /// Number of squares along a side.
    squares: usize,
    /// Positions of the vertices, row by row, squares + 1 in each; metres.
    positions: Vec<DVec3>,
    /// Velocities of the vertices, metres per second.
    velocities: Vec<DVec3>,
    before: Vec<DVec3>,
    /// Number of steps done.
    step: u64,
}

impl Simulation {
    /// Makes the cloth before it falls: level.
    pub fn new(squares: usize) -> Self {
        let place = |index: usize| {
            let (row, column) = (index / (squares + 1), index % (squares + 1));
            let along = |count: usize| SIDE * (count as f64 / squares as f64 - 0.5);
            let (x, z) = (along(column), along(row));
            DVec3::new(TURN.0 * x + TURN.1 * z + OFFSET.0, START, TURN.0 * z - TURN.1 * x + OFFSET.1)
        };
        let positions: Vec<DVec3> = (0..(squares + 1) * (squares + 1)).map(place).collect();
        Self {
            squares,
            velocities: vec![DVec3::ZERO; positions.len()],
            before: positions.clone(),
            positions,
            step: 0,
        }
    }

    /// Returns the number of squares along a side.
    pub fn squares(&self) -> usize {
        self.squares
    }

    /// Positions of the vertices, row by row, metres.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Returns the number of steps per second.
    fn rate(&self) -> u64 {
        STEPS * (self.squares as u64).div_ceil(SQUARES)
    }

    /// Advances to the step nearest to a time in seconds, at least 0; starts again if that step has passed.
    pub fn advance_to(&mut self, seconds: f64) {
        let wanted = (seconds * self.rate() as f64).round() as u64;
        if wanted < self.step {
            *self = Self::new(self.squares);
        }
        while self.step < wanted {
            self.advance();
        }
    }

    fn advance(&mut self) {
        let seconds = 1.0 / self.rate() as f64;
        let kept = 1.0 - DRAG * seconds;
        self.before.clone_from(&self.positions);
        for (position, velocity) in self.positions.iter_mut().zip(&mut self.velocities) {
            velocity.y -= GRAVITY * seconds;
            *velocity *= kept;
            *position += *velocity * seconds;
        }
        self.keep_lengths();
        let clearance = clearance(self.squares);
        for (position, before) in self.positions.iter_mut().zip(&self.before) {
            *position = outside(*position, *before, clearance);
        }
        for ((velocity, position), before) in
            self.velocities.iter_mut().zip(&self.positions).zip(&self.before)
        {
            *velocity = (*position - *before) / seconds;
        }
        self.calm();
        self.step += 1;
    }

    /// Draws every velocity towards the mean velocity of its neighbours.
    fn calm(&mut self) {
        let side = self.squares + 1;
        // Positions before the step are not needed any more.
        let old = &mut self.before;
        old.clone_from(&self.velocities);
        for (vertex, velocity) in self.velocities.iter_mut().enumerate() {
            let (row, column) = (vertex / side, vertex % side);
            let (mut sum, mut count) = (DVec3::ZERO, 0.0);
            let mut add = |is_there: bool, other: usize| {
                if is_there {
                    sum += old[other];
                    count += 1.0;
                }
            };
            add(column > 0, vertex.wrapping_sub(1));
            add(column + 1 < side, vertex + 1);
            add(row > 0, vertex.wrapping_sub(side));
            add(row + 1 < side, vertex + side);
            *velocity += (sum / count - *velocity) * THREADS;
        }
    }

    /// Corrects every distance once, from the first vertex to the last and in the next step from the last to
    /// the first, so that no direction is preferred and a pull reaches across the cloth in one step.
    fn keep_lengths(&mut self) {
        let side = self.squares + 1;
        let square = SIDE / self.squares as f64;
        let span = ((BEND_SPAN / square).round() as usize).clamp(2, self.squares);
        // An implicitly solved spring corrects this share of a deviation.
        let share = |rate: f64| {
            let steps = self.rate() as f64 / rate;
            1.0 / (1.0 + steps * steps)
        };
        let (shear, bend) = (share(SHEAR), share(BEND));
        let diagonal = square * 2.0_f64.sqrt();
        let positions = &mut self.positions;
        let mut correct = |vertex: usize| {
            let (row, column) = (vertex / side, vertex % side);
            let (right, below) = (column + 1 < side, row + 1 < side);
            if right {
                keep(positions, vertex, vertex + 1, square, 1.0);
            }
            if below {
                keep(positions, vertex, vertex + side, square, 1.0);
            }
            if right && below {
                keep(positions, vertex, vertex + side + 1, diagonal, shear);
                keep(positions, vertex + 1, vertex + side, diagonal, shear);
            }
            if column + span < side {
                keep(positions, vertex, vertex + span, span as f64 * square, bend);
            }
            if row + span < side {
                keep(positions, vertex, vertex + span * side, span as f64 * square, bend);
            }
        };
        if self.step.is_multiple_of(2) {
            (0..side * side).for_each(&mut correct);
        } else {
            (0..side * side).rev().for_each(&mut correct);
        }
    }
}

/// Returns the distance that vertices keep from the ball and the ground, metres, so that the surface between
/// them stays clear too.
fn clearance(squares: usize) -> f64 {
    let square = SIDE / squares as f64;
    // Depth of the centre of a square's diagonal below the sphere that its ends lie on.
    CLEARANCE + square * square / (4.0 * RADIUS)
}

/// Moves two vertices towards or away from one another, by `share` of the deviation of their distance.
fn keep(positions: &mut [DVec3], a: usize, b: usize, distance: f64, share: f64) {
    let between = positions[b] - positions[a];
    let length = between.length();
    if length > 0.0 {
        let half = between * (0.5 * share * (length - distance) / length);
        positions[a] += half;
        positions[b] -= half;
    }
}

/// Moves a vertex out of ball and ground, slowed by friction.
fn outside(mut position: DVec3, before: DVec3, clearance: f64) -> DVec3 {
    if position.y < clearance {
        let depth = clearance - position.y;
        position.y = clearance;
        position = slowed(position, before, DVec3::Y, FRICTION.1 * depth);
    }
    let out = position - MIDDLE;
    let distance = out.length();
    if distance < RADIUS + clearance {
        let normal = if distance > 0.0 { out / distance } else { DVec3::Y };
        let depth = RADIUS + clearance - distance;
        position += normal * depth;
        position = slowed(position, before, normal, FRICTION.0 * depth);
        // The movement along the sphere, not off it.
        let out = position - MIDDLE;
        position = MIDDLE + out * ((RADIUS + clearance) / out.length());
    }
    position
}

/// Takes back up to `most` metres of a vertex's movement along a surface.
fn slowed(position: DVec3, before: DVec3, normal: DVec3, most: f64) -> DVec3 {
    let moved = position - before;
    let along = moved - normal * moved.dot(normal);
    let length = along.length();
    if length <= most { position - along } else { position - along * (most / length) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the FNV-1a hash of all bits.
    fn checksum(simulation: &Simulation) -> u64 {
        let numbers = simulation.positions().iter().flat_map(|position| position.to_array());
        numbers.flat_map(|number| number.to_bits().to_le_bytes()).fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
    }

    #[test]
    fn every_machine_gets_the_same_bits() {
        let mut simulation = Simulation::new(40);
        simulation.advance_to(1.0);
        assert_eq!(checksum(&simulation), 0x9973_00bd_df69_05e6);
    }

    #[test]
    fn going_on_and_starting_again_lead_to_the_same_place() {
        let at = |times: &[f64]| {
            let mut simulation = Simulation::new(16);
            times.iter().for_each(|&seconds| simulation.advance_to(seconds));
            checksum(&simulation)
        };
        let once = at(&[0.5]);
        assert_eq!(at(&[0.04, 0.08, 0.31, 0.5]), once);
        assert_eq!(at(&[0.8, 0.5]), once);
        assert_ne!(at(&[0.5 + 1.0 / 1200.0]), once);
    }

    #[test]
    fn the_cloth_stays_whole_and_outside_of_ball_and_ground() {
        let mut simulation = Simulation::new(48);
        let square = SIDE / 48.0;
        for tenth in 0..=30 {
            simulation.advance_to(f64::from(tenth) / 10.0);
            for (index, position) in simulation.positions().iter().enumerate() {
                assert!(position.distance(MIDDLE) > RADIUS + 0.9 * CLEARANCE && position.y > 0.9 * CLEARANCE);
                if (index + 1) % 49 != 0 {
                    let length = position.distance(simulation.positions()[index + 1]);
                    assert!((0.7..1.2).contains(&(length / square)), "{tenth}: {}", length / square);
                }
            }
        }
        // The cloth lies on the ball, and its corners on the ground.
        let positions = simulation.positions();
        let highest = positions.iter().map(|position| position.y).fold(0.0, f64::max);
        assert!((highest - MIDDLE.y - RADIUS).abs() < 0.03, "{highest}");
        assert!([0, 48, 49 * 48, 49 * 49 - 1].iter().all(|&corner| positions[corner].y < 0.05));
        let before = positions.to_vec();
        simulation.advance_to(3.2);
        let moved = before.iter().zip(simulation.positions()).map(|(a, b)| a.distance_squared(*b));
        let moved = (moved.sum::<f64>() / before.len() as f64).sqrt();
        assert!(moved < 0.003, "it has come to rest: {moved} m in 0.2 s");
    }
}
