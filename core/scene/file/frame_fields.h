#pragma once
// The fields that frames of a scene hold in addition to motion and masses.

namespace dartboard {

/// Fields that a scene does not ask for are neither computed nor held.
struct FrameFields {
  bool held = false;          // which vertices are free, fixed or driven
  bool stress = false;        // measures of the stress of vertices; of a chain, tensions of links
  bool displacement = false;  // of vertices, from where they were at rest
  bool springs = false;       // every spring as a line, with its strain
  bool contact = false;       // of vertices: the force of contacts, and how deep they are inside
  bool attachments = false;   // the springs of attachments as lines; of pictures, not of files
};

}  // namespace dartboard
