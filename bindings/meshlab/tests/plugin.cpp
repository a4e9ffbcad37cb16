// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loads and runs the plugin for its tests.
#include "plugin.h"

#include <QFileInfo>
#include <QPluginLoader>

Plugin::Plugin(const QString &file) {
  QPluginLoader loader(QFileInfo(file).absoluteFilePath());
  filters_ = qobject_cast<MeshFilterInterface *>(loader.instance());
  if (filters_ == nullptr) qFatal("%s: %s", qUtf8Printable(file), qUtf8Printable(loader.errorString()));
  filters_->setLog(&log_);
}

RichParameterList Plugin::parameters(const char *filter, MeshDocument &document) {
  RichParameterList found;
  filters_->initParameterSet(filters_->AC(QString(filter)), document, found);
  return found;
}

bool Plugin::apply(const char *filter, MeshDocument &document, const RichParameterList &given, vcg::CallBackPos *callback) {
  return filters_->applyFilter(filters_->AC(QString(filter)), document, given, callback);
}

std::string Plugin::log() const {
  QStringList lines;
  log_.print(lines);
  return lines.join("\n").toStdString();
}
