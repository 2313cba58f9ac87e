/* Checkpoints: the State buffer on disk, so that a run can go on with the same bits.
 *
 * File: 8 bytes magic, then native 64-bit words: format version, fingerprint of the model, bytes of the state, its
 * state_hash; then the state's buffer. */
#ifndef BILLOW_CHECKPOINT_H
#define BILLOW_CHECKPOINT_H

#include <stdint.h>

#include "solver/diagnostics.h"
#include "solver/model.h"
#include "solver/state.h"

#define BILLOW_CHECKPOINT_NAME "restart.billow"

/* Hash of all that a state depends on: sizes, node and element ids, mesh, masses, groups, bags, curves. End time and
 * output intervals are left out, so that a run may be prolonged. */
uint64_t checkpoint_fingerprint(const Model *model);

/* Writes state to path through a temporary file and a rename: path holds the old or the new checkpoint, never half of
 * one. Returns 0, or -1 with an environment error. */
int checkpoint_write(const char *path, const Model *model, const State *state, Diagnostics *diagnostics);

/* Reads path into state, which state_create has made for this model. Returns 0, or -1 with an error (not a checkpoint,
 * another format, another deck, cut off, damaged); state is then unchanged or must be thrown away. */
int checkpoint_read(const char *path, const Model *model, State *state, Diagnostics *diagnostics);

#endif
