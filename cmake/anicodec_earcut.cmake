# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# EARCUT_SOURCE: the folder of mapbox/earcut.hpp, a header that cuts polygons into triangles, which a Python package has.
include(anicodec_source)
anicodec_source(EARCUT mapbox-earcut 2.1.0 fb0c1e43581a635bbaabf4a5149009014d370c515816c4d5a7d8118477f28d48 include)
