/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Plays a clip while it arrives: coarsely first. Every time a layer has come, the asset is replaced
 * by a finer one.
 */
#include <anicodec/anicodec.h>

#include <stdio.h>
#include <stdlib.h>

/* The middle of the clip, as it looks so far. */
static anic_status show(const anic_asset* asset, const anic_stream_info* arrived) {
  anic_context* context;
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  anic_box box;
  anic_get_asset_info(asset, &info);
  anic_status status = anic_create_context(asset, NULL, &context);
  if (status == ANIC_OK)
    status = anic_seek_time(context, info.duration / 2, ANIC_SAMPLE_STEP, ANIC_WRAP_CLAMP);
  if (status == ANIC_OK)
    status = anic_compute_bounds(context, 0, ANIC_WHEN_CURRENT, &box);
  printf("%llu of %llu bytes, %u of %u layers: ", (unsigned long long)arrived->received_bytes,
         (unsigned long long)arrived->file_bytes, (unsigned)arrived->arrived_layers,
         (unsigned)arrived->layers);
  if (status == ANIC_OK)
    printf("%s, from %.6g %.6g %.6g to %.6g %.6g %.6g\n", info.partial ? "coarse" : "whole",
           box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]);
  else
    printf("%s\n", status == ANIC_E_ABSENT ? "not there yet" : anic_get_status_text(status));
  anic_destroy_context(context);
  return status == ANIC_E_ABSENT ? ANIC_OK : status;
}

int main(int argc, char** argv) {
  FILE* file = argc == 2 ? fopen(argv[1], "rb") : NULL;
  if (file == NULL) {
    fprintf(stderr, "usage: stream CLIP.anic\n");
    return 1;
  }
  anic_stream* stream;
  anic_asset* asset = NULL;
  anic_stream_info info = ANIC_INIT(anic_stream_info);
  anic_status status = anic_create_stream(NULL, &stream);
  uint32_t shown = 0;
  unsigned char packet[64];
  size_t size;
  while (status == ANIC_OK && (size = fread(packet, 1, sizeof packet, file)) > 0) {
    if ((status = anic_push_bytes(stream, packet, size)) != ANIC_OK)
      break;
    anic_get_stream_info(stream, &info);
    if (!info.playable || (asset != NULL && info.arrived_layers == shown && !info.complete))
      continue;
    anic_close_asset(asset); /* contexts of the old one are gone by now */
    shown = info.arrived_layers;
    status = anic_open_asset_from_stream(stream, &asset, NULL);
    if (status == ANIC_OK)
      status = show(asset, &info);
  }
  fclose(file);
  if (status != ANIC_OK)
    fprintf(stderr, "%s: %s\n", argv[1], anic_get_status_text(status));
  else
    anic_get_stream_info(stream, &info);
  anic_destroy_stream(stream);
  anic_close_asset(asset);
  return status == ANIC_OK && info.complete ? 0 : 1;
}
