use super::problem::Candidate;
use super::random::Random;

/// Spread of the crossover: the greater, the nearer children stay to their parents.
const CROSSOVER_INDEX: f64 = 15.0;
/// Maximum mutation, as a share of the bounds, and the maximum number of its halvings.
const MUTATION: (f64, f64) = (0.3, 40.0);
/// Share of the pairs that are crossed.
const CROSSED: f64 = 0.9;

/// Children of a real-coded genetic algorithm: tournaments of two, simulated binary crossover (Deb and Agrawal 1995), and on
/// average one mutation per child, of any order of magnitude, large ones more often, after the breeder genetic algorithm
/// (Mühlenbein and Schlierkamp-Voosen 1993, DOI 10.1162/evco.1993.1.1.25).
pub(super) fn children(population: &[Candidate], random: &mut Random) -> Vec<Vec<f64>> {
    let mut children = Vec::with_capacity(population.len() + 1);
    while children.len() < population.len() {
        let mut parent = || {
            let pair = [0; 2].map(|_| &population[random.index(population.len())]);
            let first = pair[0].evaluation.order(&pair[1].evaluation).is_le();
            pair[usize::from(!first)].point.clone()
        };
        let (mut a, mut b) = (parent(), parent());
        if random.share() < CROSSED {
            for (x, y) in a.iter_mut().zip(&mut b) {
                if random.share() < 0.5 {
                    let u = random.share();
                    let power = 1.0 / (CROSSOVER_INDEX + 1.0);
                    let spread = if u < 0.5 {
                        (2.0 * u).powf(power)
                    } else {
                        (0.5 / (1.0 - u)).powf(power)
                    };
                    let (middle, half) = (0.5 * (*x + *y), 0.5 * spread * (*y - *x));
                    (*x, *y) = (middle - half, middle + half);
                }
            }
        }
        for child in [a, b] {
            let mut child = child;
            let chance = 1.0 / child.len() as f64;
            for x in &mut child {
                if random.share() < chance {
                    let size = MUTATION.0 * (-MUTATION.1 * random.share().powi(3)).exp2();
                    *x += if random.share() < 0.5 { size } else { -size };
                }
                *x = x.clamp(0.0, 1.0);
            }
            children.push(child);
        }
    }
    children.truncate(population.len());
    children
}

/// The best of parents and children.
pub(super) fn select(population: &mut Vec<Candidate>, children: Vec<Candidate>) {
    let count = population.len();
    population.extend(children);
    population.sort_by(|a, b| a.evaluation.order(&b.evaluation));
    population.truncate(count);
}
