/* Newton's method on a tangent that is not symmetric: its product with a vector by differences of the residual, solved
 * by GMRES with the factor of the symmetric one; the residual judges a step. Equations (Q20) to (Q22) of
 * docs/theory.md. */
#include "solver/relax_exact.h"

#include <math.h>
#include <string.h>

#include "solver/gmres.h"
#include "solver/memory.h"
#include "solver/signals.h"

enum { HALVINGS = 6, PATIENCE = 60 };

typedef struct Exact {
    RelaxSystem *system;
    const NewtonOptions *options;
    double *x, *trial, *next;                       /* positions (node_count x 3) */
    double *residual, *ahead, *back, *after, *step; /* (unknown_count) */
    double *work;                                   /* of GMRES */
    double size;                                    /* of the model [L] */
    NewtonResult *result;
} Exact;

bool relax_needs_exact(const RelaxSystem *system)
{
    for (int g = 0; g < system->model->group_count; g++)
        if (!static_law_is_symmetric(system->model->groups[g].law, &system->model->groups[g].material)) return true;
    return false;
}

static double length(int n, const double *a)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += a[i] * a[i];
    return sqrt(sum);
}

static double largest(int n, const double *a)
{
    double most = 0.0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(a[i]));
    return most;
}

/* (J + s D) v, J by central differences (eq. Q20). */
static int apply_tangent(void *user, const double *v, double *out)
{
    Exact *e = user;
    RelaxSystem *s = e->system;
    double load, most = largest(s->unknown_count, v), h = most > 0.0 ? 1e-7 * e->size / most : 1.0;
    relax_system_move(s, e->x, h, v, e->trial);
    relax_system_assemble(s, e->trial, false, e->ahead, &load);
    relax_system_move(s, e->x, -h, v, e->trial);
    relax_system_assemble(s, e->trial, false, e->back, &load);
    for (int i = 0; i < s->unknown_count; i++)
        out[i] = (e->back[i] - e->ahead[i]) / (2.0 * h) + e->result->shift * s->scale[i] * v[i];
    return 0;
}

static int apply_factor(void *user, const double *v, double *out)
{
    return relax_system_backsolve(((Exact *)user)->system, v, out);
}

/* The step of (Q21). */
static int find_step(Exact *e)
{
    RelaxSystem *s = e->system;
    int status;
    for (;;) {
        e->result->factorisations++;
        status = relax_system_solve(s, e->result->shift, e->residual, e->step);
        if (status <= 0 || e->result->factorisations >= e->options->iterations) break;
        e->result->shift = fmax(4.0 * e->result->shift, 1e-8);
    }
    if (status) return status;
    GmresProblem problem = {s->unknown_count, apply_tangent, apply_factor, e};
    return gmres_solve(&problem, e->residual, 1e-3, e->work, e->step);
}

/* Takes the step or one of its halves if the residual falls (eq. Q22); the shift follows. */
static void take_step(Exact *e, double *left, double *load)
{
    RelaxSystem *s = e->system;
    const int n = s->unknown_count;
    const double most = fmin(1.0, 0.05 * e->size / fmax(largest(n, e->step), 1e-300));
    double factor = most;
    for (int half = 0; half < HALVINGS; half++, factor *= 0.5) {
        relax_system_move(s, e->x, factor, e->step, e->next);
        relax_system_assemble(s, e->next, false, e->after, load);
        double now = length(n, e->after);
        if (!(now < (1.0 - 1e-3 * factor) * *left)) continue;
        if (half == 0 && most == 1.0)
            e->result->shift *= now < 0.5 * *left ? 0.1 : 0.3;
        else if (half > 1)
            e->result->shift *= 3.0;
        e->result->shift = fmax(e->result->shift, 1e-14);
        memcpy(e->x, e->next, 3 * (size_t)s->model->node_count * sizeof *e->x);
        relax_system_assemble(s, e->x, true, e->residual, load);
        *left = now;
        e->result->steps++;
        return;
    }
    e->result->shift = fmax(8.0 * e->result->shift, 1e-8);
}

static int iterate(Exact *e)
{
    NewtonResult *result = e->result;
    double load, best = INFINITY;
    int since = 0; /* factorisations since the residual was half of the best */
    relax_system_assemble(e->system, e->x, true, e->residual, &load);
    double left = length(e->system->unknown_count, e->residual);
    for (;;) {
        result->load = fmax(load, result->load);
        result->residual = result->load > 0.0 ? left / result->load : left;
        if (e->options->progress)
            fprintf(e->options->progress, "%4d %4d  residual %.3e  shift %.1e  exact\n", result->steps,
                    result->factorisations, result->residual, result->shift);
        if (result->residual <= e->options->tolerance) return 0;
        if (result->residual < 0.5 * best) {
            best = result->residual;
            since = result->factorisations;
        }
        result->stopped = signals_stop_requested();
        if (result->stopped || result->factorisations >= e->options->iterations || result->shift > 10.0 ||
            result->factorisations > since + PATIENCE)
            return 1;
        int status = find_step(e);
        if (status) return status;
        take_step(e, &left, &load);
    }
}

int relax_exact(RelaxSystem *system, const NewtonOptions *options, double size, double *x, NewtonResult *result)
{
    size_t count = (size_t)system->unknown_count + 1, nodes = 3 * (size_t)system->model->node_count + 1;
    Exact e = {.system = system,
               .options = options,
               .x = x,
               .trial = memory_alloc(nodes, sizeof(double)),
               .next = memory_alloc(nodes, sizeof(double)),
               .residual = memory_alloc(count, sizeof(double)),
               .ahead = memory_alloc(count, sizeof(double)),
               .back = memory_alloc(count, sizeof(double)),
               .after = memory_alloc(count, sizeof(double)),
               .step = memory_alloc(count, sizeof(double)),
               .work = memory_alloc(GMRES_SIZE(count), sizeof(double)),
               .size = size,
               .result = result};
    void *blocks[] = {e.trial, e.next, e.residual, e.ahead, e.back, e.after, e.step, e.work};
    int status = 0;
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++)
        if (!blocks[i]) status = -1;
    if (!status) status = iterate(&e);
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) memory_free(blocks[i]);
    return status;
}
