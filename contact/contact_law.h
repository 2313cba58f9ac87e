/* Parts of the law of one pair (docs/theory.md, Contact) in scalar form, for smooth shapes; contact/push_kernels.c has
 * all of it for surfaces. */
#ifndef BILLOW_CONTACT_LAW_H
#define BILLOW_CONTACT_LAW_H

#include <math.h>

#include "contact/contact_push.h"
#include "solver/elementary.h"
#include "solver/vector3.h"

/* Masses of one pair. */
typedef struct ContactMasses {
    double effective; /* eq. C3; 0: nothing of it can move */
    double load;      /* C of eq. C6 */
    double least;     /* M, the least m/S of its nodes */
    double firm;      /* the same as M with the loads of pairs at the limit alone */
    double stiff;     /* B, the least m R/S of them: k dt^2 must not be larger (eq. C4) */
} ContactMasses;

/* (w dt)^2 that contact in the direction d may add at a node of this ContactNode.room (eq. C12). */
static inline double contact_room(const double *h, const double *d)
{
    return 1.0 / (h[0] * d[0] * d[0] + h[1] * d[1] * d[1] + h[2] * d[2] * d[2] +
                  2.0 * (h[3] * d[0] * d[1] + h[4] * d[1] * d[2] + h[5] * d[2] * d[0]));
}

/* A pair that was not in contact (eq. C8). What it is closer by than it can have come in the last step, it was before.
 */
static inline void contact_begin(const ContactTouch *t, double normal_speed, double before, ContactMemory *m)
{
    double came = normal_speed < 0.0 ? -normal_speed * before : 0.0;
    *m = (ContactMemory){.side = t->side, .distance = t->gap + came < t->thickness ? t->gap + came : t->thickness};
}

/* An initial penetration eases; one that parts gets the distance at which its mean depth over the step is zero, so that
 * it goes without a push (eq. C8b). cleared: the gap, of a parting pair less h. */
static inline void contact_ease(const ContactTouch *t, double cleared, bool new_pair, ContactMemory *m)
{
    if (cleared > t->thickness) cleared = t->thickness;
    if (cleared > m->distance || (new_pair && cleared < t->gap)) m->distance = cleared;
}

/* Tangential force on the node: a spring that slips at the friction limit (eq. C9, C10). */
static inline void contact_friction(const ContactLaw *law, const ContactTouch *t, double normal_speed,
                                    double normal_force, double stiffness, ContactMemory *m)
{
    double slip[3], friction[3] = {m->friction[0], m->friction[1], m->friction[2]}, speed2 = 0.0;
    double along = vector3_dot(friction, t->direction);
    for (int k = 0; k < 3; k++) {
        slip[k] = t->speed[k] - normal_speed * t->direction[k];
        speed2 += slip[k] * slip[k];
        friction[k] -= along * t->direction[k] + stiffness * law->before * slip[k];
    }
    double mu = law->static_friction;
    if (law->decay > 0.0)
        mu = law->dynamic_friction +
             (mu - law->dynamic_friction) * elementary_exp(-law->decay * sqrt(speed2)); /* eq. C11 */
    double size = vector3_norm(friction), most = mu * normal_force, scale = size <= most ? 1.0 : most / size;
    for (int k = 0; k < 3; k++) m->friction[k] = (float)(scale * friction[k]);
}

/* Mean over the step of a penetration that grows or shrinks by 2 h, as far as it is positive (eq. C2). */
static inline double contact_mean_depth(double depth, double h)
{
    if (depth >= h) return depth;
    return depth <= -h ? 0.0 : (depth + h) * (depth + h) / (4.0 * h);
}

/* The stiffness follows the step as long as its bound allows; where it rises under load the distance falls, so that
 * no energy comes of it (eq. C4a). */
static inline void contact_stiffen(const ContactTouch *t, double stiffness, bool new_pair, ContactMemory *m)
{
    if (new_pair || stiffness < m->stiffness) {
        m->stiffness = stiffness;
    } else if (stiffness > 1.25 * m->stiffness) {
        if (m->distance > t->gap) m->distance = t->gap + (m->distance - t->gap) * sqrt(m->stiffness / stiffness);
        m->stiffness = stiffness;
    }
}

#endif
