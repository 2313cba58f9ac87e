/* Termination, step control and the plan of outputs. */
#include <math.h>
#include <string.h>

#include "solver/builder.h"

/* Interval of one *DATABASE card; the first of equal names counts. */
static double interval(const Builder *b, const char *name)
{
    const Definitions *d = b->definitions;
    for (size_t i = 0; i < d->databases.count; i++)
        if (strcmp(d->databases.items[i].name, name) == 0) return d->databases.items[i].dt;
    return 0.0;
}

static int mark_history_nodes(Builder *b, unsigned char *wanted)
{
    const Definitions *d = b->definitions;
    int status = 0;
    for (size_t i = 0; i < d->histories.count; i++) {
        const HistoryDefinition *history = &d->histories.items[i];
        if (!history->is_set) {
            int32_t node = id_map_find(&b->index.nodes, history->id);
            if (node < 0) {
                diagnostics_add(b->diagnostics, SEVERITY_ERROR, history->source, "*DATABASE_HISTORY_NODE",
                                "node %d is not defined in the deck", history->id);
                status = -1;
            } else {
                wanted[node] = 1;
            }
            continue;
        }
        IndexList nodes = {0};
        if (sets_resolve_nodes(&b->index, history->id, history->source, "*DATABASE_HISTORY_NODE_SET", &nodes,
                               b->diagnostics))
            status = -1;
        for (size_t k = 0; k < nodes.count; k++) wanted[nodes.items[k]] = 1;
        index_list_free(&nodes);
    }
    return status;
}

/* Nodes of *DATABASE_HISTORY_NODE in deck order; renumbered with the model. */
static int history_nodes(Builder *b)
{
    OutputPlan *plan = &b->model->output;
    const int node_count = (int)b->definitions->nodes.count; /* the builder counts them later, with the shells */
    unsigned char *wanted = builder_alloc(b, (size_t)node_count, 1);
    if (!wanted) return -1;
    int status = mark_history_nodes(b, wanted), count = 0;
    for (int i = 0; i < node_count; i++) count += wanted[i];
    plan->history_node = builder_alloc(b, (size_t)count + 1, sizeof *plan->history_node);
    if (!plan->history_node) return -1;
    for (int i = 0; i < node_count; i++)
        if (wanted[i]) plan->history_node[plan->history_count++] = i;
    return status;
}

/* Largest share of the elements' stable step that leaves something to contact (theory, eq. C5). */
#define STEP_WITH_CONTACT 0.94

static int step_control(Builder *b)
{
    const ControlDefinitions *c = &b->definitions->control;
    Model *m = b->model;
    m->step_scale = c->timestep.given && c->timestep.tssfac > 0.0 ? c->timestep.tssfac : 0.9;
    if (b->definitions->contacts.count > 0 && m->step_scale > STEP_WITH_CONTACT) {
        diagnostics_add(b->diagnostics, SEVERITY_NOTE, c->timestep.source, "*CONTROL_TIMESTEP",
                        "TSSFAC = %g leaves no room for contact; %g is used", m->step_scale, STEP_WITH_CONTACT);
        m->step_scale = STEP_WITH_CONTACT;
    }
    m->step_initial = c->timestep.given ? c->timestep.dtinit : 0.0;
    m->step_minimum = c->termination.given ? c->termination.dtmin : 0.0;
    m->step_limit_curve = -1;
    if (c->timestep.given && c->timestep.lctm) {
        m->step_limit_curve = deck_index_curve(&b->index, c->timestep.lctm, "LCTM", c->timestep.source,
                                               "*CONTROL_TIMESTEP", b->diagnostics);
        if (m->step_limit_curve < 0) return -1;
    }
    return 0;
}

/* The phase before the run: --relax, or IDRFLG. */
static void relax_control(Builder *b)
{
    const ControlDefinitions *c = &b->definitions->control;
    RelaxControl *relax = &b->model->relax;
    int flag = c->relaxation.given ? c->relaxation.idrflg : 0;
    relax->source = BILLOW_NO_SOURCE;
    if (b->options->relax && flag != 1 && flag != 5) {
        relax->kind = RELAX_STATIC;
        relax->tolerance = 1e-8;
        return;
    }
    if (flag != 1 && flag != 5) return;
    *relax = (RelaxControl){.kind = flag == 5 ? RELAX_STATIC : RELAX_DYNAMIC,
                            .phase_curves = true,
                            .time = c->relaxation.drterm,
                            .tolerance = flag == 5 ? 1e-8 : c->relaxation.drtol,
                            .check_cycles = c->relaxation.nrcyck,
                            .factor = c->relaxation.drfctr,
                            .step_scale = c->relaxation.tssfdr > 0.0 ? c->relaxation.tssfdr : b->model->step_scale,
                            .automatic = c->relaxation.irelal == 1,
                            .automatic_tolerance = c->relaxation.edttl,
                            .source = c->relaxation.source};
}

int build_output(Builder *b)
{
    const ControlDefinitions *c = &b->definitions->control;
    Model *m = b->model;
    int status = step_control(b);
    memcpy(m->title, b->definitions->title, sizeof m->title);
    m->end_time = b->options->end_time > 0.0 ? b->options->end_time : c->termination.endtim;
    m->end_cycle = c->termination.endcyc;
    m->energy_error_limit = b->options->energy_error_limit > 0.0 ? b->options->energy_error_limit : 0.1;
    if (!(m->end_time > 0.0)) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, c->termination.given ? c->termination.source : (Source){0, 0},
                        "*CONTROL_TERMINATION",
                        "no end time: give ENDTIM > 0 in *CONTROL_TERMINATION, or --end-time on the command line");
        status = -1;
    }
    m->output.states = interval(b, "BINARY_D3PLOT");
    m->output.glstat = interval(b, "GLSTAT");
    m->output.abstat = interval(b, "ABSTAT");
    m->output.nodout = interval(b, "NODOUT");
    m->output.rbdout = interval(b, "RBDOUT");
    m->output.rcforc = interval(b, "RCFORC");
    m->output.gceout = interval(b, "GCEOUT");
    m->output.rwforc = interval(b, "RWFORC");
    m->output.matsum = interval(b, "MATSUM");
    m->output.restart = interval(b, "BINARY_D3DUMP");
    if (history_nodes(b)) status = -1;
    relax_control(b);
    return status;
}
