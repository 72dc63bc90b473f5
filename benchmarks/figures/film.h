#pragma once
// A run as a moving picture: an animated GIF, drawn by gnuplot.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "benchmarks/figures/body_panel.h"

namespace dartboard {

/// The most pictures of a film, after the first.
inline constexpr std::uint64_t most_film_pictures = 120;

/// Draw panels one after the other at one scale, each with its time; writes `name`.gif with its data and its script.
///
/// The film is as fast as the motion, except for motions of less than 4 or more than 12 seconds. Where the bodies move
/// far beyond their size, the picture follows them.
/// pre     there is a panel
/// returns what went wrong, as `draw` does
/// throws  IoError when the files cannot be written
std::string draw_film(std::span<const BodyPanel> panels, const Look& look, const std::string& title,
                      const std::filesystem::path& folder, const std::string& name,
                      const std::string& gnuplot = "gnuplot");

}  // namespace dartboard
