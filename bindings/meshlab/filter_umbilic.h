// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plugin as MeshLab sees it: three filters, their texts, and what of a mesh each needs and changes.
#ifndef UMBILIC_MESHLAB_FILTER_UMBILIC_H
#define UMBILIC_MESHLAB_FILTER_UMBILIC_H

#include <common/interfaces.h>

#include <umbilic.hpp>

class FilterUmbilic : public QObject, public MeshFilterInterface {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
  Q_INTERFACES(MeshFilterInterface)

 public:
  enum { NORMALS, CURVATURE, SEGMENTATION };

  FilterUmbilic();

  QString pluginName() const override;
  QString filterName(FilterIDType filter) const override;
  QString filterInfo(FilterIDType filter) const override;
  FilterClass getClass(QAction *action) override;
  FILTER_ARITY filterArity(QAction *action) const override;
  int getPreConditions(QAction *action) const override;
  int postCondition(QAction *action) const override;
  void initParameterSet(QAction *action, MeshDocument &document, RichParameterList &parameters) override;
  bool applyFilter(QAction *action, MeshDocument &document, const RichParameterList &given, vcg::CallBackPos *callback) override;

 private:
  void normals(MeshModel &model, const RichParameterList &given, umbilic::progress_reference progress);
  void curvature(MeshModel &model, const RichParameterList &given, umbilic::progress_reference progress);
  void segmentation(MeshModel &model, const RichParameterList &given, umbilic::progress_reference progress);

  /** The log's lines on what was done, and how many vertices it left without a result. */
  void tell(const CMeshO &mesh, std::size_t faces, double faces_ms, double library_ms, double rest_ms);
  void tell_of_missing(const std::vector<std::uint8_t> &statuses);
};

#endif  // UMBILIC_MESHLAB_FILTER_UMBILIC_H
