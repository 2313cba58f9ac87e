/* Verification runs: reference geometry and comparisons. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

static void cross_product(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Triple product a . (b x c). */
static double triple_product(const double a[3], const double b[3], const double c[3])
{
    double n[3];
    cross_product(b, c, n);
    return a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
}

/* Volume of the cone from the origin over a bilinear patch: exact, the mean over both splits into triangles. */
double verify_volume(const SceneMesh *mesh, const double *x)
{
    double volume = 0;
    for (int e = 0; e < mesh->shell_count; e++) {
        const int *n = mesh->shell[e];
        const double *a = x + 3 * n[0], *b = x + 3 * n[1], *c = x + 3 * n[2], *d = x + 3 * n[3];
        if (n[3] == n[2])
            volume += triple_product(a, b, c) / 6;
        else
            volume += (triple_product(a, b, c) + triple_product(a, c, d) + triple_product(a, b, d) +
                       triple_product(b, c, d)) /
                      12;
    }
    return volume;
}

/* Area; a quad's by 5 x 5 Gauss points on the bilinear patch. */
double verify_area(const SceneMesh *mesh, const double *x)
{
    static const double point[5] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                    0.9061798459386640};
    static const double weight[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                     0.2369268850561891};
    double area = 0;
    for (int e = 0; e < mesh->shell_count; e++) {
        const int *n = mesh->shell[e];
        double u[3], v[3], normal[3];
        if (n[3] == n[2]) {
            for (int k = 0; k < 3; k++) {
                u[k] = x[3 * n[1] + k] - x[3 * n[0] + k];
                v[k] = x[3 * n[2] + k] - x[3 * n[0] + k];
            }
            cross_product(u, v, normal);
            area += 0.5 * sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
            continue;
        }
        for (int i = 0; i < 25; i++) {
            double s = point[i % 5], t = point[i / 5];
            for (int k = 0; k < 3; k++) {
                double a = x[3 * n[0] + k], b = x[3 * n[1] + k], c = x[3 * n[2] + k], d = x[3 * n[3] + k];
                u[k] = 0.25 * ((1 - t) * (b - a) + (1 + t) * (c - d));
                v[k] = 0.25 * ((1 - s) * (d - a) + (1 + s) * (c - b));
            }
            cross_product(u, v, normal);
            area += weight[i % 5] * weight[i / 5] *
                    sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        }
    }
    return area;
}

void verify_begin_box(Scene *scene, const double size[3], double lid_mass, int con1, double end_time)
{
    const double thickness = 0.01;
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_add_box(&scene->mesh, 1, 2, 3, size[0], size[1], size[2]);
    scene_begin(deck, "box with a rigid lid", end_time, 0);
    scene_write_part(deck, 1, 1, 1, "bottom");
    scene_write_part(deck, 2, 1, 2, "lid");
    scene_write_part(deck, 3, 2, 3, "walls");
    scene_write_section(deck, 1, 9, thickness);
    scene_write_section(deck, 2, 9, 1e-6);
    scene_write_rigid(deck, 1, 7800, 7, 7);
    scene_write_rigid(deck, 2, lid_mass / (size[0] * size[1] * thickness), con1, 7);
    scene_write_null(deck, 3, 1e-6);
    scene_write_part_set(deck, 1, 3, (const int[]){1, 2, 3});
    scene_write_curve(deck, 1, 2, (const double[]){0, 0, 1, 0});
}

void verify_close(const char *name, double value, double reference, double tolerance)
{
    double error = value / reference - 1;
    print_message("    %-34s %.10g, reference %.10g, off by %.2g (allowed %.2g)\n", name, value, reference, error,
                  tolerance);
    if (!(fabs(error) <= tolerance)) fail_msg("%s: %.10g is not %.10g within %g", name, value, reference, tolerance);
}

void verify_near(const char *name, double value, double reference, double tolerance)
{
    print_message("    %-34s %.10g, reference %.10g, off by %.2g (allowed %.2g)\n", name, value, reference,
                  value - reference, tolerance);
    if (!(fabs(value - reference) <= tolerance))
        fail_msg("%s: %.10g is not %.10g +- %g", name, value, reference, tolerance);
}

void verify_between(const char *name, double value, double low, double high)
{
    print_message("    %-34s %.10g, allowed %.10g to %.10g\n", name, value, low, high);
    if (!(value >= low && value <= high)) fail_msg("%s: %.10g is not in %.10g ... %.10g", name, value, low, high);
}
