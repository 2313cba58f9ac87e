/* *RIGIDWALL cards -> walls: shape, motion, nodes; then the same in the model's order of nodes. */
#include <math.h>
#include <string.h>

#include "solver/builder.h"
#include "solver/coordinates.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* A gap above minus this share of the model's size is in front of a wall: rounding of sums of steps. */
static const double TOLERANCE_SHARE = 1e-9;

/* (w dt)^2 that the penalty on a rigid body may have with RWPNAL = 1, and at most. */
static const double PENALTY = 0.4, LARGEST_PENALTY = 0.7;

static const char *wall_keyword(const RigidWallDefinition *d)
{
    static const char *const names[] = {"*RIGIDWALL_PLANAR", "*RIGIDWALL_GEOMETRIC_FLAT", "*RIGIDWALL_GEOMETRIC_SPHERE",
                                        "*RIGIDWALL_GEOMETRIC_CYLINDER", "*RIGIDWALL_GEOMETRIC_PRISM"};
    return names[d->kind];
}

/* Axes l, m, n of the wall; l is made perpendicular to n. */
static int find_axes(Builder *b, const RigidWallDefinition *d, RigidWall *wall)
{
    double *l = wall->axes, *m = wall->axes + 3, *n = wall->axes + 6;
    vector3_subtract(d->head, d->tail, n);
    if (!(vector3_normalize(n) > 0.0)) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, d->plane_source, wall_keyword(d),
                        "the normal of the wall is zero: its head (XH, YH, ZH) = (%g, %g, %g) is its tail; give the "
                        "head a place on the side where the nodes are",
                        d->head[0], d->head[1], d->head[2]);
        return -1;
    }
    bool edge = d->finite;
    if (edge)
        vector3_subtract(d->edge, d->tail, l);
    else
        l[fabs(n[0]) < 0.6 ? 0 : 1] = 1.0;
    double length = vector3_norm(l), along = vector3_dot(l, n);
    for (int k = 0; k < 3; k++) l[k] -= along * n[k];
    if (!(vector3_normalize(l) > 1e-9 * length)) {
        if (d->lenl > 0.0 || d->lenm > 0.0) {
            diagnostics_add(b->diagnostics, SEVERITY_ERROR, d->edge_source, wall_keyword(d),
                            "the edge (XHEV, YHEV, ZHEV) = (%g, %g, %g) gives no direction across the normal; give a "
                            "point beside the tail in the wall's plane",
                            d->edge[0], d->edge[1], d->edge[2]);
            return -1;
        }
        l[0] = l[1] = l[2] = 0.0;
        l[fabs(n[0]) < 0.6 ? 0 : 1] = 1.0;
        along = vector3_dot(l, n);
        for (int k = 0; k < 3; k++) l[k] -= along * n[k];
        vector3_normalize(l);
    }
    vector3_cross(n, l, m);
    return 0;
}

static int refuse_number(Builder *b, const RigidWallDefinition *d, Source source, const char *field, double value,
                         const char *advice)
{
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, source, wall_keyword(d), "%s = %g %s", field, value, advice);
    return -1;
}

static int find_shape(Builder *b, const RigidWallDefinition *d, RigidWall *wall)
{
    static const WallShape shapes[] = {WALL_PLANE, WALL_PLANE, WALL_SPHERE, WALL_CYLINDER, WALL_PRISM};
    int status = find_axes(b, d, wall);
    wall->shape = shapes[d->kind];
    memcpy(wall->origin, d->tail, sizeof wall->origin);
    wall->length[0] = d->lenl;
    wall->length[1] = d->lenm;
    wall->length[2] = d->kind == RIGIDWALL_CYLINDER ? d->lencyl : d->lenp;
    wall->radius = d->radius;
    const char *const fields[] = {"LENL", "LENM", d->kind == RIGIDWALL_CYLINDER ? "LENCYL" : "LENP"};
    for (int k = 0; k < 3; k++)
        if (wall->length[k] < 0.0)
            status = refuse_number(b, d, d->edge_source, fields[k], wall->length[k],
                                   "is negative; give a length, or 0 for an infinite wall");
    if ((d->kind == RIGIDWALL_SPHERE || d->kind == RIGIDWALL_CYLINDER) && !(d->radius > 0.0))
        status = refuse_number(b, d, d->edge_source, d->kind == RIGIDWALL_SPHERE ? "RADSPH" : "RADCYL", d->radius,
                               "must be positive: it is the wall's radius");
    return status;
}

static int find_friction(Builder *b, const RigidWallDefinition *d, RigidWall *wall)
{
    bool planar = d->kind == RIGIDWALL_PLANAR;
    wall->welds = planar && (d->fric == 2.0 || d->fric == 3.0);
    wall->weld_speed = d->wvel;
    wall->sliding = d->fric == 1.0 || (planar && d->fric == 3.0) ? WALL_NO_SLIDING : WALL_FRICTION;
    wall->friction = wall->welds ? 0.0 : d->fric;
    if (wall->welds || (d->fric >= 0.0 && d->fric <= 1.0)) return 0;
    return refuse_number(b, d, d->plane_source, "FRIC", d->fric,
                         planar ? "is neither a coefficient from 0 to 1 nor 2 or 3 (nodes weld)"
                                : "is no coefficient from 0 to 1 (1: no sliding)");
}

static int find_motion(Builder *b, const RigidWallDefinition *d, RigidWall *wall)
{
    int status = 0;
    wall->curve = -1;
    wall->birth = d->birth;
    wall->death = d->death;
    if (d->moving) {
        wall->mass = d->mass;
        wall->speed = d->v0;
        if (!(d->mass > 0.0))
            status = refuse_number(b, d, d->moving_source, "MASS", d->mass,
                                   "must be positive; a wall that is driven is *RIGIDWALL_GEOMETRIC_FLAT_MOTION");
    }
    if (!d->motion) return status;
    memcpy(wall->direction, d->v, sizeof wall->direction);
    wall->displacement = d->opt == 1;
    wall->curve = deck_index_curve(&b->index, d->lcid, "LCID", d->moving_source, wall_keyword(d), b->diagnostics);
    if (wall->curve < 0) status = -1;
    if (d->opt != 0 && d->opt != 1)
        status = refuse_number(b, d, d->moving_source, "OPT", d->opt, "is neither 0 (velocity) nor 1 (displacement)");
    if (!(vector3_normalize(wall->direction) > 0.0)) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, d->moving_source, wall_keyword(d),
                        "the direction of the motion VX, VY, VZ is zero; give its direction cosines");
        status = -1;
    }
    return status;
}

/* Nodes of NSID (all if 0) without those of NSIDEX, in BOXID, and, of all nodes, not farther in front than OFFSET. */
static int mark_nodes(Builder *b, const RigidWallDefinition *d, RigidWall *wall, unsigned char *named)
{
    const char *keyword = wall_keyword(d);
    IndexList list = {0};
    int status = 0;
    if (d->nsid == 0) {
        memset(named, 1, (size_t)b->node_count);
    } else {
        if (sets_resolve_nodes(&b->index, d->nsid, d->source, keyword, &list, b->diagnostics)) status = -1;
        for (size_t k = 0; k < list.count; k++) named[list.items[k]] = 1;
    }
    if (d->nsidex != 0) {
        if (sets_resolve_nodes(&b->index, d->nsidex, d->source, keyword, &list, b->diagnostics)) status = -1;
        for (size_t k = 0; k < list.count; k++) named[list.items[k]] = 0;
    }
    index_list_free(&list);
    if (d->boxid != 0) {
        const BoxDefinition *box = coordinates_resolve_box(&b->index, d->boxid, d->source, keyword, b->diagnostics);
        if (!box) return -1;
        for (int n = 0; n < b->node_count; n++)
            if (!coordinates_in_box(box, b->x + 3 * (ptrdiff_t)n)) named[n] = 0;
    }
    for (int n = 0; d->offset > 0.0 && n < b->node_count; n++) {
        double r[3];
        vector3_subtract(b->x + 3 * (ptrdiff_t)n, wall->origin, r);
        if (rigid_wall_gap(wall, r).distance > d->offset) named[n] = 0;
    }
    return status;
}

static double model_size(const Builder *b)
{
    double size = 0.0;
    for (int i = 0; i < 3 * b->node_count; i++) size = fmax(size, fabs(b->x[i]));
    return size;
}

/* How many nodes, and how many of them behind: what billow check says. */
static void count_nodes(Builder *b, RigidWall *wall, const unsigned char *named)
{
    for (int n = 0; n < b->node_count; n++) {
        double r[3];
        if (!named[n]) continue;
        wall->node_count++;
        vector3_subtract(b->x + 3 * (ptrdiff_t)n, wall->origin, r);
        if (rigid_wall_gap(wall, r).distance < -wall->tolerance) wall->behind_count++;
    }
}

int build_walls(Builder *b)
{
    const Definitions *d = b->definitions;
    Model *m = b->model;
    size_t nodes = (size_t)b->node_count;
    double tolerance = TOLERANCE_SHARE * model_size(b);
    int status = 0;
    if (d->walls.count == 0) return 0;
    m->walls = builder_alloc(b, d->walls.count, sizeof *m->walls);
    b->wall_node = memory_alloc(d->walls.count * nodes + 1, 1);
    if (!m->walls || !b->wall_node) return -1;
    m->wall_count = (int)d->walls.count;
    for (int i = 0; i < m->wall_count; i++) {
        const RigidWallDefinition *definition = &d->walls.items[i];
        RigidWall *wall = &m->walls[i];
        unsigned char *named = b->wall_node + (size_t)i * nodes;
        wall->id = definition->id ? definition->id : i + 1;
        memcpy(wall->title, definition->title, sizeof wall->title);
        int shape = find_shape(b, definition, wall);
        wall->tolerance = fmax(tolerance, TOLERANCE_SHARE * vector3_norm(wall->origin));
        if (shape | find_friction(b, definition, wall) | find_motion(b, definition, wall) |
            mark_nodes(b, definition, wall, named))
            status = -1;
        if (shape == 0) count_nodes(b, wall, named);
        if (wall->mass > 0.0) m->has_moving_walls = true;
    }
    return status;
}

/* Moving rigid parts that the wall does not see: a note, but a warning where more is asked for than billow has, or
 * where the wall stops nothing else, which is hardly meant so. */
static void warn_of_passing(Builder *b, const RigidWallDefinition *d, const RigidWall *wall)
{
    const ControlDefinitions *control = &b->definitions->control;
    const bool asked = control->contact.given && control->contact.rwpnal > 0.0;
    diagnostics_add(b->diagnostics, asked || wall->rigid_count == wall->node_count ? SEVERITY_WARNING : SEVERITY_NOTE,
                    d->source, wall_keyword(d), "%d nodes of moving rigid parts pass through rigid wall %d%s",
                    wall->rigid_count, wall->id,
                    asked ? ": RWPNAL acts on walls without mass only (no MOVING)"
                          : ", as in LS-DYNA with RWPNAL = 0; RWPNAL = 1 in *CONTROL_CONTACT stops them");
}

static void warn(Builder *b, const RigidWallDefinition *d, const RigidWall *wall)
{
    if (wall->node_count == 0)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, d->source, wall_keyword(d),
                        "rigid wall %d has no nodes to act on; look at NSID, NSIDEX, BOXID and OFFSET", wall->id);
    if (wall->behind_count > 0)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, d->source, wall_keyword(d),
                        "%s%d of the %d nodes of rigid wall %d start behind it; as in LS-DYNA it lets them move "
                        "towards its front only; turn its normal or exclude them if that is not meant",
                        wall->behind_count == wall->node_count ? "all " : "", wall->behind_count, wall->node_count,
                        wall->id);
    if (wall->rigid_count > 0) warn_of_passing(b, d, wall);
}

/* Stiffness x dt^2 on each node of each body: the stable share over the trace of (W12). Of what the wall cannot meet 0.
 */
static int share_penalty(Builder *b, RigidWall *wall)
{
    const int bodies = b->motion.rigid_body_count;
    wall->body_penalty = builder_alloc(b, (size_t)bodies + 1, sizeof *wall->body_penalty);
    if (!wall->body_penalty) return -1;
    for (int i = 0; i < bodies; i++) {
        RigidBody *body = &b->motion.rigid_bodies[i];
        double trace = 0.0;
        for (int k = 0; k < body->node_count; k++) {
            const double *r = body->offset + 3 * (ptrdiff_t)k;
            double square = vector3_dot(r, r);
            body->reach = fmax(body->reach, sqrt(square));
            if (!wall->pushed[body->node[k]]) continue;
            trace += 1.0 / body->mass;
            for (int c = 0; c < 3; c++)
                if (body->inertia[c] > 0.0) trace += (square - r[c] * r[c]) / body->inertia[c];
        }
        wall->body_penalty[i] = trace > 0.0 ? wall->penalty / trace : 0.0;
    }
    return 0;
}

/* The wall's part of the stable penalty, and the nodes that it acts on. */
static int push_bodies(Builder *b, RigidWall *wall, const unsigned char *named)
{
    const Model *m = b->model;
    const ControlDefinitions *control = &b->definitions->control;
    double scale = control->contact.given ? control->contact.rwpnal : 0.0;
    if (!(scale > 0.0) || wall->mass > 0.0 || b->motion.rigid_body_count == 0) return 0;
    wall->penalty = fmin(PENALTY * scale, LARGEST_PENALTY);
    wall->pushed = builder_alloc(b, (size_t)m->moving_count + 1, 1);
    if (!wall->pushed) return -1;
    for (int n = 0; n < b->node_count; n++)
        if (m->deck_node[n] < m->moving_count) wall->pushed[m->deck_node[n]] = named[n];
    b->model->walls_push_bodies = true;
    return share_penalty(b, wall);
}

int build_wall_nodes(Builder *b)
{
    Model *m = b->model;
    const Constraints *constraints = &b->motion.constraints;
    for (int i = 0; i < m->wall_count; i++) {
        RigidWall *wall = &m->walls[i];
        const unsigned char *named = b->wall_node + (size_t)i * (size_t)b->node_count;
        wall->tracked = builder_alloc(b, (size_t)m->moving_count + 1, 1);
        if (!wall->tracked || push_bodies(b, wall, named)) return -1;
        for (int n = 0; n < b->node_count; n++)
            if (m->deck_node[n] < m->moving_count) wall->tracked[m->deck_node[n]] = named[n];
        for (int k = 0; k < b->motion.rigid_body_count; k++) {
            const RigidBody *body = &b->motion.rigid_bodies[k];
            for (int n = 0; n < body->node_count; n++) {
                *(wall->pushed ? &wall->pushed_count : &wall->rigid_count) += wall->tracked[body->node[n]];
                wall->tracked[body->node[n]] = 0;
            }
        }
        /* hanging nodes follow their edge */
        for (int h = 0; h < constraints->hanging_count; h++)
            if (constraints->hanging[h].node < m->moving_count) wall->tracked[constraints->hanging[h].node] = 0;
        warn(b, &b->definitions->walls.items[i], wall);
    }
    return 0;
}
