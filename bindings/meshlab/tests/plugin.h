// SPDX-License-Identifier: GPL-3.0-or-later
//
// The built plugin, loaded as MeshLab loads it, and its filters, run as MeshLab runs them.
#ifndef UMBILIC_MESHLAB_TESTS_PLUGIN_H
#define UMBILIC_MESHLAB_TESTS_PLUGIN_H

#include <common/interfaces.h>

constexpr const char *NORMALS = "Umbilic: vertex normals";
constexpr const char *CURVATURE = "Umbilic: curvature";
constexpr const char *SEGMENTATION = "Umbilic: segmentation";

class Plugin {
 public:
  /** Ends the program if there is no plugin. */
  explicit Plugin(const QString &file);

  MeshFilterInterface &filters() { return *filters_; }

  /** The parameters of a filter as its dialog shows them first. */
  RichParameterList parameters(const char *filter, MeshDocument &document);

  /** Whether the filter was applied. */
  bool apply(const char *filter, MeshDocument &document, const RichParameterList &given, vcg::CallBackPos *callback = nullptr);

  /** What the last filter that was not applied says. */
  std::string message() { return filters_->errorMsg().toStdString(); }

  /** All that has been logged, a line each. */
  std::string log() const;

 private:
  MeshFilterInterface *filters_;
  GLLogStream log_;
};

#endif  // UMBILIC_MESHLAB_TESTS_PLUGIN_H
