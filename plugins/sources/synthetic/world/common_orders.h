#pragma once

#include "plugins/sources/synthetic/world/director.h"

namespace plaza::synthetic {

/// Engages `count` people and lets them appear all over the floor, away from each other.
void spread(Director& director, int count, ClothingStyle style);

/// Sends a person to the other side of the floor's centre, passing it within about `scatter_m`.
void cross(Director& director, std::size_t who, double slowest_mps, double fastest_mps,
           double scatter_m);

/// Lets a person and one that walks nearby meet for a while, between the two. False when nobody is
/// there who could.
bool meet_someone(Director& director, std::size_t who, double shortest_s, double longest_s);

/// Sends a person somewhere on the floor, lets it stand there, look around or hold its arms
/// somehow.
void roam(Director& director, std::size_t who, double slowest_mps, double fastest_mps,
          double longest_stand_s);

/// How two people greet: a handshake or a hug, and some talk after it.
std::vector<Phase> greeting(Random& random, double seconds);

}  // namespace plaza::synthetic
