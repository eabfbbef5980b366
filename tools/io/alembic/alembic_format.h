// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_FORMAT_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_FORMAT_H_

namespace anicodec::tools {

struct FileFormat;

extern const FileFormat kAlembic;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_FORMAT_H_
