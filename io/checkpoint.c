/* Checkpoints: the State buffer on disk, so that a run can go on with the same bits. */
#include "io/checkpoint.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char magic[8] = {'B', 'I', 'L', 'L', 'O', 'W', 'C', 'K'};
enum { CHECKPOINT_FORMAT = 1 };

typedef struct Header {
    char magic[8];
    uint64_t format, model, size, checksum;
} Header;

static uint64_t hash_bytes(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *byte = data;
    if (!byte) return hash;
    for (size_t i = 0; i < size; i++) hash = (hash ^ byte[i]) * 1099511628211u;
    return hash;
}

static uint64_t hash_int(uint64_t hash, int64_t value)
{
    return hash_bytes(hash, &value, sizeof value);
}

static uint64_t hash_double(uint64_t hash, double value)
{
    return hash_bytes(hash, &value, sizeof value);
}

static uint64_t hash_mesh(uint64_t hash, const Model *model)
{
    const size_t nodes = (size_t)model->node_count, elements = (size_t)model->element_count;
    hash = hash_int(hash, model->node_count);
    hash = hash_int(hash, model->free_count);
    hash = hash_int(hash, model->moving_count);
    hash = hash_bytes(hash, model->node_id, nodes * sizeof *model->node_id);
    hash = hash_bytes(hash, model->initial, 3 * nodes * sizeof *model->initial);
    hash = hash_bytes(hash, model->mass, nodes * sizeof *model->mass);
    hash = hash_int(hash, model->element_count);
    hash = hash_bytes(hash, model->element_id, elements * sizeof *model->element_id);
    hash = hash_bytes(hash, model->element_part, elements * sizeof *model->element_part);
    hash = hash_bytes(hash, model->element_node, 4 * elements * sizeof *model->element_node);
    return hash_bytes(hash, model->element_thickness, elements * sizeof *model->element_thickness);
}

static uint64_t hash_groups(uint64_t hash, const Model *model)
{
    hash = hash_int(hash, (int64_t)model->history_size);
    hash = hash_int(hash, model->group_count);
    for (int i = 0; i < model->group_count; i++) {
        const ElementGroup *group = &model->groups[i];
        hash = hash_int(hash, group->kind);
        hash = hash_int(hash, group->law);
        hash = hash_int(hash, group->part);
        hash = hash_int(hash, group->element_count);
        const FabricLaw *law = &group->material;
        const double constants[] = {law->fabric.d11, law->fabric.d12, law->fabric.d22, law->fabric.d33,
                                    law->liner.d11,  law->liner.d12,  law->liner.d22,  law->liner.d33,
                                    law->damping,    law->density,    law->hourglass};
        hash = hash_bytes(hash, constants, sizeof constants);
        hash = hash_int(hash, law->no_compression);
        if (!group->has_reference) continue;
        size_t size = (size_t)group->block_count * (size_t)group->geometry_size * BILLOW_LANES;
        hash = hash_bytes(hash, group->geometry, size * sizeof *group->geometry);
        hash = hash_double(hash, group->birth);
        hash = hash_int(hash, 8 * (int)group->rule.restore + 2 * group->rdt + group->rule.liner_waits);
    }
    return hash;
}

static uint64_t hash_bags(uint64_t hash, const Model *model)
{
    hash = hash_int(hash, model->airbag_count);
    for (int i = 0; i < model->airbag_count; i++) {
        const Airbag *bag = &model->airbags[i];
        const GasModel *gas = &bag->gas;
        const double constants[] = {bag->vsca,
                                    bag->psca,
                                    bag->vini,
                                    gas->cv,
                                    gas->cp,
                                    gas->a,
                                    gas->b,
                                    gas->molar_mass,
                                    gas->vent_area,
                                    gas->porosity_area,
                                    bag->ambient,
                                    gas->ambient_pressure,
                                    gas->inflow_temperature};
        hash = hash_int(hash, bag->id);
        hash = hash_int(hash, gas->kind);
        hash = hash_bytes(hash, constants, sizeof constants);
        for (int k = 0; k < gas->species_count; k++) {
            hash = hash_double(hash, gas->species[k].molar_mass);
            hash = hash_bytes(hash, gas->species[k].piece[0].cp, sizeof gas->species[k].piece[0].cp);
            hash = hash_double(hash, gas->sources[k].initial_fraction);
        }
        const double laws[] = {gas->pressure_volume.coefficient,
                               gas->pressure_volume.factor,
                               gas->adiabatic.gamma,
                               gas->adiabatic.factor,
                               gas->load_curve.start_time,
                               gas->fluid.bulk,
                               gas->overpressure,
                               gas->density};
        hash = hash_bytes(hash, laws, sizeof laws);
        for (int k = 0; k < gas->leak_count; k++) {
            const GasLeak *leak = &gas->leaks[k];
            const double factors[] = {leak->coefficient, leak->factor, leak->open, leak->x[0], leak->x[1]};
            hash = hash_bytes(hash, factors, sizeof factors);
            hash = hash_int(hash, leak->option);
        }
        hash = hash_int(hash, gas->hole_count);
        hash = hash_int(hash, bag->node_count);
        hash = hash_int(hash, bag->closure.cap_count);
    }
    return hash;
}

static uint64_t hash_conditions(uint64_t hash, const Model *model)
{
    hash = hash_int(hash, model->curve_count);
    for (int i = 0; i < model->curve_count; i++) {
        const Curve *curve = &model->curves[i];
        hash = hash_int(hash, curve->count);
        hash = hash_bytes(hash, curve->x, (size_t)curve->count * sizeof *curve->x);
        hash = hash_bytes(hash, curve->y, (size_t)curve->count * sizeof *curve->y);
    }
    for (int i = 0; i < model->connection_count; i++) {
        const GasConnection *c = &model->connections[i];
        hash = hash_int(hash, c->bag[0]);
        hash = hash_int(hash, c->bag[1]);
        hash = hash_double(hash, c->area);
        hash = hash_double(hash, c->coefficient);
    }
    hash = hash_int(hash, model->segment_load_count);
    hash = hash_int(hash, model->loads.node_load_count);
    hash = hash_int(hash, model->loads.rigid_load_count);
    hash = hash_int(hash, model->walls_block);
    hash = hash_int(hash, model->constraints.support_count);
    hash = hash_int(hash, model->constraints.motion_count);
    hash = hash_int(hash, model->constraints.hanging_count);
    hash = hash_int(hash, model->rigid_body_count);
    return hash_double(hash, model->step_scale);
}

uint64_t checkpoint_fingerprint(const Model *model)
{
    uint64_t hash = 14695981039346656037u;
    hash = hash_mesh(hash, model);
    hash = hash_groups(hash, model);
    hash = hash_bags(hash, model);
    hash = hash_int(hash, model->part_count);
    return hash_conditions(hash, model);
}

/* Writes header and buffer to file and on to the disk; false if something failed. */
static bool write_all(FILE *file, const Header *header, const State *state)
{
    return fwrite(header, sizeof *header, 1, file) == 1 && fwrite(state->buffer, 1, state->size, file) == state->size &&
           fflush(file) == 0 && fsync(fileno(file)) == 0;
}

int checkpoint_write(const char *path, const Model *model, const State *state, Diagnostics *diagnostics)
{
    char temporary[PATH_MAX];
    if (snprintf(temporary, sizeof temporary, "%s.new", path) >= (int)sizeof temporary) {
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "the name of %s is too long", path);
        return -1;
    }
    Header header = {.format = CHECKPOINT_FORMAT,
                     .model = checkpoint_fingerprint(model),
                     .size = state->size,
                     .checksum = state_hash(state)};
    memcpy(header.magic, magic, sizeof magic);
    FILE *file = fopen(temporary, "wb");
    bool good = file && write_all(file, &header, state);
    int cause = good ? 0 : errno;
    if (file && fclose(file) && good) {
        good = false;
        cause = errno;
    }
    if (good && rename(temporary, path)) {
        good = false;
        cause = errno;
    }
    if (good) return 0;
    if (file) unlink(temporary);
    diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "cannot write the checkpoint %s: %s",
                    path, strerror(cause));
    return -1;
}

/* The first thing wrong with the header, in words that say what to do, or NULL. */
static const char *judge_header(const Header *header, const Model *model, const State *state)
{
    if (memcmp(header->magic, magic, sizeof magic) != 0) return "is not a checkpoint of billow";
    if (header->format != CHECKPOINT_FORMAT)
        return "was written by another version of billow: restart with that version, or run from time 0";
    if (header->model != checkpoint_fingerprint(model) || header->size != state->size)
        return "belongs to another deck: restart with the deck and the options of the first run (end time and output "
               "intervals may differ)";
    return NULL;
}

int checkpoint_read(const char *path, const Model *model, State *state, Diagnostics *diagnostics)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL, "cannot open the checkpoint %s: %s", path,
                        strerror(errno));
        return -1;
    }
    Header header;
    const char *wrong = NULL;
    if (fread(&header, sizeof header, 1, file) != 1)
        wrong = "is not a checkpoint of billow";
    else
        wrong = judge_header(&header, model, state);
    if (!wrong) {
        const size_t got = fread(state->buffer, 1, state->size, file);
        if (got != state->size || fgetc(file) != EOF || state_hash(state) != header.checksum)
            wrong = "is damaged or cut off: use an older checkpoint, or run from time 0";
    }
    fclose(file);
    if (!wrong) return 0;
    diagnostics_add(diagnostics, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL, "%s %s", path, wrong);
    return -1;
}
