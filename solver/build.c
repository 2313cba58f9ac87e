/* Definitions -> Model: the stages in order. */
#include "solver/build.h"

#include <dlfcn.h>
#include <string.h>

#include "solver/build_contact.h"
#include "solver/builder.h"
#include "solver/memory.h"

int builder_adopt(Builder *b, void *block)
{
    Model *m = b->model;
    if (!block) return 0;
    if (memory_reserve((void **)&m->owned, &m->owned_capacity, m->owned_count + 1, sizeof *m->owned)) {
        memory_free(block);
        diagnostics_add(b->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "no memory for the model");
        return -1;
    }
    m->owned[m->owned_count++] = block;
    return 0;
}

void *builder_alloc(Builder *b, size_t count, size_t size)
{
    void *block = memory_alloc(count, size);
    if (!block) {
        diagnostics_add(b->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "no memory for the model");
        return NULL;
    }
    return builder_adopt(b, block) ? NULL : block;
}

/* Lumped masses in deck order. */
static void lump_masses(Builder *b)
{
    for (int i = 0; i < b->record_count; i++) {
        const ShellRecord *r = &b->records[i];
        for (int a = 0; a < r->corner_count; a++) b->mass[r->node[a]] += r->mass / r->corner_count;
    }
    for (int i = 0; i < b->model->solid_count; i++)
        for (int a = 0; a < 8; a++) b->mass[b->model->solids[i].node[a]] += b->model->solids[i].share[a];
    for (int n = 0; b->link_mass && n < b->node_count; n++) b->mass[n] += b->link_mass[n];
    for (int i = 0; i < b->point_mass_count; i++) b->mass[b->point_masses[i].node] += b->point_masses[i].mass;
}

/* Supports, loads, rigid bodies. */
static int build_movement(Builder *b)
{
    Model *m = b->model;
    double *shell_mass = memory_alloc((size_t)b->shell_count, sizeof *shell_mass);
    AirbagNodes *bags = memory_alloc((size_t)m->airbag_count + 1, sizeof *bags);
    if (!shell_mass || !bags) {
        memory_free(shell_mass);
        memory_free(bags);
        return -1;
    }
    for (int i = 0; i < b->shell_count; i++) shell_mass[i] = b->records[i].mass;
    for (int i = 0; i < m->airbag_count; i++)
        bags[i] = (AirbagNodes){m->airbags[i].node_count, m->airbags[i].node, b->definitions->airbags.items[i].mwd};
    MotionInput input = {.index = &b->index,
                         .x = b->x,
                         .shell_mass = shell_mass,
                         .point_mass_count = b->point_mass_count,
                         .point_masses = b->point_masses,
                         .airbag_count = m->airbag_count,
                         .airbags = bags,
                         .relaxation_phase = b->options->relaxation_phase,
                         .relaxed = m->relax.kind != RELAX_NONE};
    int status = build_motion(&input, b->mass, &b->motion, b->diagnostics);
    memory_free(shell_mass);
    memory_free(bags);
    return status;
}

/* The Model takes over what the motion builders made. */
static int take_motion(Builder *b)
{
    Model *m = b->model;
    Motion *motion = &b->motion;
    m->constraints = motion->constraints;
    m->loads = motion->loads;
    m->node_class = motion->node_class;
    m->rigid_body_count = motion->rigid_body_count;
    m->rigid_bodies = motion->rigid_bodies;
    m->segment_load_count = motion->segment_load_count;
    m->segment_loads = motion->segment_loads;
    for (int p = 0; p < m->part_count; p++) m->parts[p].rigid_body = motion->part_body[p];
    void *blocks[] = {motion->constraints.supports, motion->constraints.motions, motion->constraints.hanging,
                      motion->loads.node_loads,     motion->loads.classes,       motion->node_class,
                      motion->rigid_bodies,         motion->segment_loads,       motion->loads.rigid_loads};
    int status = 0;
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) status |= builder_adopt(b, blocks[i]);
    for (int i = 0; i < motion->rigid_body_count; i++)
        status |= builder_adopt(b, motion->rigid_bodies[i].node) | builder_adopt(b, motion->rigid_bodies[i].offset);
    motion->constraints = (Constraints){0};
    motion->loads = (Loads){0};
    motion->node_class = NULL;
    motion->rigid_bodies = NULL;
    motion->rigid_body_count = 0;
    motion->segment_loads = NULL;
    return status;
}

/* Volumes are summed about the middle of the model. */
static void set_origin(Builder *b)
{
    Model *m = b->model;
    for (int k = 0; k < 3; k++) {
        double low = b->x[k], high = b->x[k];
        for (int i = 0; i < b->node_count; i++) {
            double x = b->x[3 * i + k];
            low = x < low ? x : low;
            high = x > high ? x : high;
        }
        m->origin[k] = 0.5 * (low + high);
    }
    for (int i = 0; i < m->airbag_count; i++) {
        m->airbags[i].closure = b->closures[i];
        b->closures[i] = (SurfaceClosure){0};
    }
}

static void builder_free(Builder *b)
{
    for (int i = 0; b->closures && i < b->model->airbag_count; i++) surface_closure_free(&b->closures[i]);
    for (int i = 0; b->contacts && i < b->model->contact_count; i++) contact_surfaces_free(&b->contacts[i]);
    memory_free(b->contacts);
    motion_free(&b->motion);
    deck_index_free(&b->index);
    void *blocks[] = {
        b->x,         b->mass,      b->records,      b->parts,      b->closures, b->order,
        b->wall_node, b->link_mass, b->point_masses, b->references, b->implicit, b->reference_classes.items};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) memory_free(blocks[i]);
}

/* --walls-block: covers are followed even where no leakage asks for them, for the contact field. */
static void block_by_walls(Builder *b)
{
    Model *m = b->model;
    if (!b->options->walls_block) return;
    m->walls_block = m->wall_count > 0;
    if (!m->walls_block || !m->blockage)
        diagnostics_add(
            b->diagnostics, SEVERITY_NOTE, BILLOW_NO_SOURCE, NULL, "--walls-block has no effect on the gas: %s",
            m->walls_block ? "no leakage or vent asks for blockage (even OPT, A23 < 0)" : "there are no rigid walls");
    m->blockage |= m->walls_block;
}

/* Each stage needs those before it; errors inside a stage are all collected. */
static int run_stages(Builder *b)
{
    int errors = b->diagnostics->errors;
    int status = deck_index_build(&b->index, b->definitions, b->diagnostics);
    if (status && b->diagnostics->errors == errors) return -1; /* a failure without a message: out of memory */
    if (build_curves(b)) status = -1;
    if (build_parts(b) | (build_output(b) ? -1 : 0)) status = -1;
    if (status) {
        /* the surfaces' and motions' messages would only repeat what is missing; elements still have their own */
        if (b->parts && b->model->parts) {
            build_shells(b);
            build_solids(b);
            build_links(b);
        }
        check_reference(b);
        return -1;
    }
    status = build_shells(b);
    if (status ? check_reference(b) : build_reference(b)) status = -1;
    if (build_solids(b)) status = -1;
    if (build_links(b)) status = -1;
    if (!status && build_masses(b)) status = -1;
    if (status) return -1;
    errors = b->diagnostics->errors;
    if (build_surfaces(b)) status = -1;
    if (status && b->diagnostics->errors == errors) return -1;
    if (build_airbags(b) || build_connections(b)) status = -1;
    if (build_walls(b)) status = -1;
    if (build_contacts(b)) status = -1;
    if (build_entities(b)) status = -1;
    if (build_mass_scaling(b)) status = -1;
    lump_masses(b);
    if (build_movement(b) || build_point_masses(b)) status = -1;
    if (build_seams(b)) status = -1;
    if (build_ties(b)) status = -1;
    if (build_erosion_parts(b)) status = -1;
    if (status) return -1;
    if (build_pressure_sets(b)) return -1;
    if (build_renumber(b) || build_contact_surfaces(b) || build_entity_nodes(b) || build_groups(b) || build_areas(b) ||
        build_wall_nodes(b) || build_link_ends(b) || build_jets(b) || build_erosion(b))
        return -1;
    set_origin(b);
    b->model->caps_push_rim = b->options->caps_push_rim;
    block_by_walls(b);
    if (take_motion(b)) return -1;
    if (build_seam_nodes(b) || build_tie_nodes(b)) return -1;
    return build_sensors(b);
}

int model_build(const Definitions *definitions, const BuildOptions *options, Model *model, Diagnostics *diagnostics)
{
    const BuildOptions none = {0};
    Builder builder = {
        .definitions = definitions, .options = options ? options : &none, .diagnostics = diagnostics, .model = model};
    *model = (Model){0};
    int errors = diagnostics->errors + diagnostics->environment;
    int status = run_stages(&builder);
    if (status && diagnostics->errors + diagnostics->environment == errors)
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "no memory for the model");
    if (diagnostics->errors + diagnostics->environment > errors) status = -1;
    builder_free(&builder);
    if (status) model_free(model);
    return status;
}

void model_free(Model *model)
{
    for (int i = 0; model->airbags && i < model->airbag_count; i++) surface_closure_free(&model->airbags[i].closure);
    for (size_t i = 0; i < model->owned_count; i++) memory_free(model->owned[i]);
    memory_free(model->owned);
    if (model->sensor_library) dlclose(model->sensor_library);
    *model = (Model){0};
}
