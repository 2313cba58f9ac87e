/* rbdout: motion of the centres of mass of all rigid parts over time, fixed ones at rest, then of nodal rigid bodies.
 */
#include <inttypes.h>
#include <math.h>

#include "io/results_files.h"
#include "solver/definitions.h"

const HistoryFormat results_rbdout_format = {"rbdout.csv", "time,part,x,y,z,vx,vy,vz,ax,ay,az", "rbdout", "1\n"};

/* Motion of one rigid part at t_n in global axes; axes holds the principal axes as rows. */
typedef struct RigidMotion {
    double x[3], u[3], rotation[3], v[3], spin[3], a[3], alpha[3];
    double axes[9];
} RigidMotion;

/* Vector r turned by the unit quaternion q. */
static void turn_vector(const double q[4], const double r[3], double turned[3])
{
    const double c[3] = {q[2] * r[2] - q[3] * r[1] + q[0] * r[0], q[3] * r[0] - q[1] * r[2] + q[0] * r[1],
                         q[1] * r[1] - q[2] * r[0] + q[0] * r[2]};
    turned[0] = r[0] + 2 * (q[2] * c[2] - q[3] * c[1]);
    turned[1] = r[1] + 2 * (q[3] * c[0] - q[1] * c[2]);
    turned[2] = r[2] + 2 * (q[1] * c[1] - q[2] * c[0]);
}

/* Rotation vector (axis times angle, up to pi) of a unit quaternion. */
static void rotation_vector(const double q[4], double rotation[3])
{
    double sine = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double sign = q[0] < 0 ? -1 : 1;
    double scale = sine > 0 ? 2 * sign * atan2(sine, sign * q[0]) / sine : 2;
    for (int c = 0; c < 3; c++) rotation[c] = scale * q[c + 1];
}

/* RigidState's own position is already that of the coming cycle; its output is that of t_n. */
static void body_motion(const Model *model, const State *state, int b, RigidMotion *motion)
{
    const RigidBody *body = &model->rigid_bodies[b];
    const RigidState *rigid = &state->rigid[b];
    const RigidOutput *output = &rigid->output;
    for (int c = 0; c < 3; c++) {
        motion->x[c] = output->x[c];
        motion->u[c] = output->x[c] - body->centre[c];
        motion->v[c] = output->v[c];
        motion->a[c] = rigid->a[c];
        motion->spin[c] = output->spin[c];
        motion->alpha[c] = rigid->alpha[c];
        turn_vector(output->rotation, body->axes + 3 * c, motion->axes + 3 * c);
    }
    rotation_vector(output->rotation, motion->rotation);
}

static void write_six(FILE *ascii, const char *name, const double linear[3], const double angular[3])
{
    fprintf(ascii, "%s", name);
    for (int c = 0; c < 3; c++) fprintf(ascii, "%12.4E", history_clip(linear[c]));
    for (int c = 0; c < 3; c++) fprintf(ascii, "%12.4E", history_clip(angular[c]));
    fprintf(ascii, "\n");
}

/* The same pair of vectors in the body's principal axes. */
static void write_six_local(FILE *ascii, const char *name, const double *axes, const double linear[3],
                            const double angular[3])
{
    double local[2][3];
    for (int c = 0; c < 3; c++) {
        const double *e = axes + (ptrdiff_t)3 * c;
        local[0][c] = e[0] * linear[0] + e[1] * linear[1] + e[2] * linear[2];
        local[1][c] = e[0] * angular[0] + e[1] * angular[1] + e[2] * angular[2];
    }
    write_six(ascii, name, local[0], local[1]);
}

static void write_ascii(FILE *ascii, int id, const RigidMotion *motion)
{
    const double *axes = motion->axes;
    fprintf(ascii, "\n rigid body%8d\n", id);
    fprintf(ascii, "   global             x           y           z          x-rot       y-rot       z-rot\n");
    fprintf(ascii, "   coordinates:  %12.4E%12.4E%12.4E\n", history_clip(motion->x[0]), history_clip(motion->x[1]),
            history_clip(motion->x[2]));
    write_six(ascii, " displacements:  ", motion->u, motion->rotation);
    write_six(ascii, "    velocities:  ", motion->v, motion->spin);
    write_six(ascii, " accelerations:  ", motion->a, motion->alpha);
    fprintf(ascii, "\nprincipal or user defined local coordinate direction vectors\n");
    fprintf(ascii, "                     a           b           c\n");
    for (int row = 0; row < 3; row++)
        fprintf(ascii, "     row%2d%15.4E%15.4E%15.4E\n", row + 1, history_clip(axes[row]), history_clip(axes[3 + row]),
                history_clip(axes[6 + row]));
    fprintf(ascii, "\n output in principal or user defined local coordinate directions\n");
    fprintf(ascii, "                      a           b           c          a-rot       b-rot       c-rot\n");
    write_six_local(ascii, " displacements:  ", axes, motion->u, motion->rotation);
    write_six_local(ascii, "    velocities:  ", axes, motion->v, motion->spin);
    write_six_local(ascii, " accelerations:  ", axes, motion->a, motion->alpha);
}

static bool has_rigid_body(const Model *model)
{
    for (int p = 0; p < model->part_count; p++)
        if (model->parts[p].material_kind == MATERIAL_RIGID) return true;
    for (int b = 0; b < model->rigid_body_count; b++)
        if (model->rigid_bodies[b].nodal) return true;
    return false;
}

static void write_row(History *history, double time, int id, const RigidMotion *motion)
{
    const double *const columns[3] = {motion->x, motion->v, motion->a};
    fprintf(history->csv.stream, "%.17g,%d", time, id);
    for (int j = 0; j < 9; j++) fprintf(history->csv.stream, ",%.17g", columns[j / 3][j % 3]);
    fprintf(history->csv.stream, "\n");
    write_ascii(history->ascii.stream, id, motion);
}

int results_write_rbdout(Results *results, const Model *model, const State *state, const StepView *view)
{
    static const RigidMotion rest = {.axes = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    History *history = &results->history[HISTORY_RBDOUT];
    double time = state->clock->time;
    (void)view;
    if (!has_rigid_body(model)) return 0;
    int go = history_begin(history, time, model->title);
    if (go <= 0) return go;
    fprintf(history->ascii.stream,
            "1\n\n  r i g i d   b o d y   m o t i o n   a t  cycle=%8" PRId64 "    time=%15.6E\n", state->clock->cycle,
            time);
    for (int p = 0; p < model->part_count; p++) {
        RigidMotion motion = rest;
        if (model->parts[p].material_kind != MATERIAL_RIGID) continue;
        for (int c = 0; c < 3; c++) motion.x[c] = results->part_centre[3 * p + c];
        if (model->parts[p].rigid_body >= 0) body_motion(model, state, model->parts[p].rigid_body, &motion);
        write_row(history, time, model->parts[p].id, &motion);
    }
    for (int b = 0; b < model->rigid_body_count; b++) {
        RigidMotion motion = rest;
        if (!model->rigid_bodies[b].nodal) continue;
        body_motion(model, state, b, &motion);
        write_row(history, time, model->rigid_bodies[b].part_id, &motion);
    }
    return history_commit(history, time);
}
