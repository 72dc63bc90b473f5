#pragma once
// Measurements of `bench contact`: steps with contact and without, forces, and the lists of candidates.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"

namespace dartboard {

/// Bodies in contact, or far from it: what is counted before anything is timed.
struct ContactCounts {
  std::string situation;
  std::size_t tetrahedra = 0, samples = 0;
  std::size_t candidates = 0;  // pairs of a sample and a tetrahedron in the list
  std::size_t contacts = 0;
  int evaluations = 1;  // in each sample of forces and lists
  // Contacts that differ from those of a list with another margin, and from those of brute force where that is
  // affordable; 1 if idle contact, or the sleep of others, has changed a bit of the motion.
  std::size_t differing = 0;
  double unbalanced = 0.0;  // the sum of the forces between bodies, over the sum of their sizes
};
void to_json(nlohmann::json& json, const ContactCounts& counts);
void from_json(const nlohmann::json& json, ContactCounts& counts);

/// The situations whose steps are timed: tasks "SITUATION: step" and "SITUATION: step without".
std::vector<std::string> stepped_situations();
/// Of these, the ones in which nothing touches.
std::vector<std::string> idle_situations();
/// The situations whose forces are timed: tasks "SITUATION: contact" and "SITUATION: elements". The last ones, plates
/// of up to so many tetrahedra, also have a task "SITUATION: list".
std::vector<std::string> pressed_situations();
std::vector<std::string> plate_situations(std::size_t largest);
/// The situations in which all bodies but one are asleep: tasks "SITUATION: step" and, of that one by itself,
/// "SITUATION: step alone". The samples counted are the bodies asleep, and tetrahedra those of one.
std::vector<std::string> asleep_situations();
/// The one that is cut through.
std::string cut_situation();

struct ContactCostPlan {
  int process = 0;
  int rounds = 12;                  // of steps; a third of them of forces, and of steps beside sleepers
  int steps = 40;                   // in each sample
  std::size_t largest = 1'000'000;  // tetrahedra of the largest plates
  int across = 6;                   // cells to an edge of the cubes that sleep
  std::uint64_t seed = 1;           // of the order of the tasks, and of the places in the pile
};

/// Take turns in this process, and report every sample; counts come first.
void measure_contact_costs(const ContactCostPlan& plan, const std::function<void(const ContactCounts&)>& counts_sink,
                           const std::function<void(const Sample&)>& sink);

}  // namespace dartboard
