#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/sampling/kernel.h"

namespace patina {

/// Metropolis-adjusted Langevin (Roberts & Tweedie 1996), preconditioned by the metric.
std::unique_ptr<Kernel> make_mala();

/// Random-walk Metropolis with proposals from N(x, step^2 C), C the metric. Makes no use of gradients.
std::unique_ptr<Kernel> make_random_walk();

/// The same with steps of all scales, from a fiftieth to half of the metric's standard deviations, whatever
/// step size is set: where a target is as narrow as nowhere else some of them still lead on (Guan & Krone
/// 2007, "Small-world MCMC and convergence to multi-modal distributions"). Warm-up does not learn from it.
std::unique_ptr<Kernel> make_walk_of_all_scales();

/// Hamiltonian Monte Carlo (Duane et al. 1987; Neal 2011): the number of leapfrog steps is drawn anew for
/// every transition, uniform from 1 to 2 path_length / step - 1.
/// @param path_length  mean length of a trajectory in standard deviations (as the metric has them)
/// @param most_steps   bound on the number of steps, and so of evaluations
/// @param careful      probability of a trajectory of steps a tenth to the whole of what warm-up says, which
///                     also leaves places that are narrower than where warm-up learnt the length
/// @throws std::invalid_argument unless length and steps are positive and careful is in [0, 1)
std::unique_ptr<Kernel> make_hmc(double path_length = 1.5, int most_steps = 24, double careful = 0.15);

/// The no-U-turn sampler (Hoffman & Gelman 2014) as Stan has it: multinomial draws and the generalised
/// criterion of Betancourt 2017 ("A conceptual introduction to Hamiltonian Monte Carlo", appendix A).
/// @param deepest  how often a trajectory may double: up to 2^deepest - 1 evaluations
/// @throws std::invalid_argument unless deepest >= 1
std::unique_ptr<Kernel> make_nuts(int deepest = 10);

/// Proposes a level for every discrete coordinate, uniform over the joint table (paper, Algorithm 1,
/// DiscreteSample).
std::unique_ptr<Kernel> make_discrete_move();

/// Proposes another level, uniform over the others, for one discrete coordinate, uniform over those that have
/// others. Where coordinates matter separately, it is accepted far more often than a joint proposal.
std::unique_ptr<Kernel> make_single_discrete_move();

/// Moves one continuous coordinate, chosen at random with jagged ones and ones that have room preferred, or
/// all jagged ones, towards a fresh draw from N(0, I): x' = sqrt(1 - b^2) x + b xi with log b uniform on (log
/// 0.1, 0) (preconditioned Crank-Nicolson; Cotter, Roberts, Stuart, White 2013). Where coordinates are scaled
/// to a prior N(0, I) it crosses flat directions, and from one basin to another, in one step, which no local
/// move does. Valid for any target.
std::unique_ptr<Kernel> make_refresh_move();

/// Proposes a coordinate's negative: where coordinates are scaled to a prior N(0, I), its image on the other
/// side of the prior's middle, over a valley that nothing walks through. Valid for any target.
std::unique_ptr<Kernel> make_mirror_move(Eigen::Index coordinate);

/// Algorithm 1: with probability alpha the continuous kernel, else the discrete move.
std::unique_ptr<Kernel> make_mixture(std::unique_ptr<Kernel> continuous, std::unique_ptr<Kernel> discrete,
                                     double alpha);

/// A gradient kernel on the coordinates that are not jagged, all others held (Gibbs' way of composing moves),
/// in the metric that is left to them. At least one coordinate must not be jagged.
std::unique_ptr<Kernel> make_smooth_block(std::unique_ptr<Kernel> kernel);

/// A kernel in the coordinates that settings.straightening straightens: as valid there as in the target's
/// own, since the map's Jacobian is part of the density. Without a map it is the kernel itself.
std::unique_ptr<Kernel> make_straightened(std::unique_ptr<Kernel> kernel);

/// Delayed acceptance (Christen & Fox 2005): transitions of a kernel under a cheap density propose where to
/// go, and the target, evaluated once, takes or refuses it by how much more it rises there than the cheap
/// one. Exact however poor the cheap density is; worth it where it is nearly the target's. A trajectory costs
/// cheap gradients only.
/// @param kernel  reversible, as all but nuts are   @param cheap  of the target's coordinates; outlives the
/// kernel
/// @param moves   transitions a proposal; several iid choices of a mixture are reversible together
/// @throws std::invalid_argument unless moves >= 1
std::unique_ptr<Kernel> make_two_stage(std::unique_ptr<Kernel> kernel, const LogDensity& cheap, int moves);

/// Rejection sampling (von Neumann 1951) of a target that is nowhere above another density, by a chain of
/// that one: `moves` transitions of a kernel under it lead to a place, which the target takes with
/// probability p / envelope, over and over until it takes one. A transition is then from one place taken to
/// the next, and what a chain does whenever it is in a set has the chain's own distribution, restricted to
/// that set (Kac 1947). After a hundred places refused it stays where it was, which leaves a reversible
/// kernel's way back as likely as the way there. Where draws of the envelope are cheap and hardly depend on
/// each other, nor do these: an evaluation of the target is worth p / envelope draws.
/// @param kernel    reversible, as all but nuts are   @param envelope  of the target's coordinates, nowhere
/// below its density; outlives the kernel
/// @throws std::invalid_argument unless moves >= 1
std::unique_ptr<Kernel> make_rejection(std::unique_ptr<Kernel> kernel, const LogDensity& envelope, int moves);

std::vector<std::string> kernel_names();

/// "joint": make_discrete_move(); "single": make_single_discrete_move().
std::vector<std::string> discrete_names();

/// The kernel for a target: the named continuous one, on the smooth coordinates, mixed with refresh moves
/// (both in straightened coordinates where warm-up found a bent ridge),
/// and with discrete moves where the target has discrete coordinates.
/// @param alpha    probability of a continuous move (named or refresh) where there are discrete coordinates,
/// (0, 1]
/// @param refresh  probability that a continuous move is a refresh move, [0, 1)
/// @param discrete  of discrete_names()
/// @param path_length  of make_hmc()
/// @throws std::invalid_argument for an unknown name or a probability out of range
std::unique_ptr<Kernel> make_kernel(const std::string& name, const LogDensity& target, double alpha,
                                    double refresh = 0, const std::string& discrete = "joint",
                                    double path_length = 1.5);

/// Whether gradients leave a coordinate of the target alone.
bool has_jagged(const LogDensity& target);

/// The share of refresh moves of one who asks for none: many where nothing else moves jagged coordinates, few
/// where gradients move all (resources/charts).
double usual_refresh(bool has_jagged);

/// The warm-up iterations of one who asks for none: fewer where gradients move all, since each then costs a
/// trajectory and learns as much more (resources/charts).
int usual_warmup(bool has_jagged);

}  // namespace patina
