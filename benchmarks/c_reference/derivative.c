/* Equations of motion (1)-(7) of Fan et al. (2013) in C: what stommel's compiled kernel is measured against.
 *
 * Written for speed by ordinary means: one rotation matrix, one sine and cosine of the mass's roll, reciprocals shared,
 * everything inline. Same equations as stommel.dynamics.equations.rates, state in momenta. SI units; symmetric
 * matrices as (xx, yy, zz, xy, xz, yz), general ones by rows.
 */

#include <math.h>
#include <stddef.h>

typedef struct { double x, y, z; } vec3;
typedef struct { double xx, yy, zz, xy, xz, yz; } sym3;
typedef struct { double a[9]; } mat3;

/* The layout of stommel.dynamics.parameters.VEHICLE_RECORD; the loader compares the sizes. */
typedef struct {
    double m, m_p, R_p;
    sym3 J_p;
    vec3 s_0;
    sym3 M_0;
    mat3 C_0;
    sym3 J_0;
    sym3 M_f;
    mat3 C_f;
    double g, V_0, kappa, alpha_T, T_0;
    vec3 r_bl, r_res;
    double rho_oil;
    double K_D0, K_D, S_beta, S_delta, K_L0, K_L;
    double K_beta, K_delta, M_zero, M_alpha, N_beta, N_delta;
    vec3 D_omega, D_omega_V;
    double Y_r, Z_q, moments_in_flow_frame;
    double alpha_attached, alpha_separated, K_N;
} params;

typedef struct {
    double rho, P, T;
    vec3 U, DU_Dt;
} water;

typedef struct { double r_px_dot, u_px, u_b, delta_r, mu, mu_dot; } controls;

typedef struct { vec3 force, moment; } wrench;
typedef struct { double D, S, L, K, M, N; } coefficients;
typedef struct { double sin_a, cos_a, sin_b, cos_b; } flow;

static inline vec3 v3(double x, double y, double z) { return (vec3){x, y, z}; }
static inline vec3 add(vec3 a, vec3 b) { return v3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline vec3 sub(vec3 a, vec3 b) { return v3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline vec3 scale(double s, vec3 a) { return v3(s * a.x, s * a.y, s * a.z); }
static inline double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static inline vec3 cross(vec3 a, vec3 b)
{
    return v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline vec3 sym_mul(const sym3 *S, vec3 a)
{
    return v3(S->xx * a.x + S->xy * a.y + S->xz * a.z,
              S->xy * a.x + S->yy * a.y + S->yz * a.z,
              S->xz * a.x + S->yz * a.y + S->zz * a.z);
}

static inline vec3 mat_mul(const mat3 *A, vec3 b)
{
    const double *a = A->a;
    return v3(a[0] * b.x + a[1] * b.y + a[2] * b.z,
              a[3] * b.x + a[4] * b.y + a[5] * b.z,
              a[6] * b.x + a[7] * b.y + a[8] * b.z);
}

static inline vec3 mat_tmul(const mat3 *A, vec3 b)
{
    const double *a = A->a;
    return v3(a[0] * b.x + a[3] * b.y + a[6] * b.z,
              a[1] * b.x + a[4] * b.y + a[7] * b.z,
              a[2] * b.x + a[5] * b.y + a[8] * b.z);
}

static inline sym3 sym_inverse(const sym3 *S)
{
    const double xx = S->yy * S->zz - S->yz * S->yz;
    const double xy = S->xz * S->yz - S->xy * S->zz;
    const double xz = S->xy * S->yz - S->xz * S->yy;
    const double d = 1.0 / (S->xx * xx + S->xy * xy + S->xz * xz);
    return (sym3){
        .xx = d * xx,
        .yy = d * (S->xx * S->zz - S->xz * S->xz),
        .zz = d * (S->xx * S->yy - S->xy * S->xy),
        .xy = d * xy,
        .xz = d * xz,
        .yz = d * (S->xy * S->xz - S->xx * S->yz),
    };
}

/* Rotation from the body to the inertial frame of the quaternion (scalar first). */
static inline mat3 rotation(const double *q)
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double xx = x * x, yy = y * y, zz = z * z;
    const double xy = x * y, xz = x * z, yz = y * z;
    const double wx = w * x, wy = w * y, wz = w * z;
    return (mat3){{
        1.0 - 2.0 * (yy + zz), 2.0 * (xy - wz), 2.0 * (xz + wy),
        2.0 * (xy + wz), 1.0 - 2.0 * (xx + zz), 2.0 * (yz - wx),
        2.0 * (xz - wy), 2.0 * (yz + wx), 1.0 - 2.0 * (xx + yy),
    }};
}

/* Share of separated flow at an angle whose size is beyond attachment. */
static inline double separation(const params *p, double angle)
{
    const double s = (fabs(angle) - p->alpha_attached) / (p->alpha_separated - p->alpha_attached);
    if (s <= 0.0)
        return 0.0;
    if (s >= 1.0)
        return 1.0;
    return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

static inline double blend(double weight, double a, double b) { return a + weight * (b - a); }

static inline coefficients attached_flow(const params *p, double alpha, double beta, double delta_r)
{
    return (coefficients){
        .D = p->K_D0 + p->K_D * alpha * alpha,
        .S = p->S_beta * beta + p->S_delta * delta_r,
        .L = p->K_L0 + p->K_L * alpha,
        .K = p->K_beta * beta + p->K_delta * delta_r,
        .M = p->M_zero + p->M_alpha * alpha,
        .N = p->N_beta * beta + p->N_delta * delta_r,
    };
}

static coefficients __attribute__((noinline, cold))
stalled_flow(const params *p, coefficients c, double alpha, double beta, double delta_r, flow f)
{
    const double a = separation(p, alpha), b = separation(p, beta);
    const double normal = p->K_N * f.sin_a * fabs(f.sin_a);
    const double in_plane = blend(b, 1.0, f.cos_b * f.cos_b);
    const double astern = blend(a, 1.0, f.cos_a) * blend(b, 1.0, f.cos_b);
    const double D = blend(a, c.D, p->K_D0 + normal * f.sin_a);
    const double broadside = p->K_N * f.sin_b * fabs(f.sin_b);
    return (coefficients){
        .D = blend(b, D, D * f.cos_b * f.cos_b + broadside * f.sin_b),
        .S = blend(b, p->S_beta * beta, broadside * f.cos_b) + astern * p->S_delta * delta_r,
        .L = in_plane * blend(a, c.L, normal * f.cos_a),
        .K = p->K_beta * blend(b, beta, f.sin_b * f.cos_b) + astern * p->K_delta * delta_r,
        .M = in_plane * blend(a, c.M, (p->M_zero + p->M_alpha * f.sin_a) * f.cos_a),
        .N = astern * (p->N_beta * blend(b, beta, f.sin_b * f.cos_b) + p->N_delta * delta_r),
    };
}

static inline vec3 flow_to_body(vec3 a, flow f)
{
    const double x = a.x * f.cos_b - a.y * f.sin_b;
    return v3(x * f.cos_a - a.z * f.sin_a, a.x * f.sin_b + a.y * f.cos_b, x * f.sin_a + a.z * f.cos_a);
}

static inline wrench viscous(const params *p, vec3 v_r, vec3 omega, double delta_r)
{
    const double in_plane_square = v_r.x * v_r.x + v_r.z * v_r.z;
    const double V_square = in_plane_square + v_r.y * v_r.y;
    if (V_square < 1e-24)
        return (wrench){{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    const double V = sqrt(V_square), in_plane = sqrt(in_plane_square);
    flow f = {0.0, 1.0, v_r.y / V, 0.0};
    double alpha = 0.0, beta;
    if (in_plane_square < 1e-20 * V_square) {
        beta = copysign(M_PI_2, v_r.y);
    } else {
        f.sin_a = v_r.z / in_plane;
        f.cos_a = v_r.x / in_plane;
        f.cos_b = in_plane / V;
        alpha = atan2(v_r.z, v_r.x);
        beta = asin(f.sin_b);
    }

    coefficients c = attached_flow(p, alpha, beta, delta_r);
    if (fabs(alpha) > p->alpha_attached || fabs(beta) > p->alpha_attached)
        c = stalled_flow(p, c, alpha, beta, delta_r, f);

    const vec3 drag = flow_to_body(v3(c.D, c.S, c.L), f);
    const vec3 force = v3(-V_square * drag.x,
                          -V_square * drag.y + p->Y_r * V * omega.z,
                          -V_square * drag.z + p->Z_q * V * omega.y);
    const vec3 moment = v3((p->D_omega.x * V_square + p->D_omega_V.x * V) * omega.x + c.K * V_square,
                           (p->D_omega.y * V_square + p->D_omega_V.y * V) * omega.y + c.M * V_square,
                           (p->D_omega.z * V_square + p->D_omega_V.z * V) * omega.z + c.N * V_square);
    if (p->moments_in_flow_frame == 0.0)
        return (wrench){force, moment};
    const vec3 turned = flow_to_body(moment, f);
    const double a = separation(p, alpha), b = separation(p, beta);
    return (wrench){force, add(turned, scale(a + b - a * b, sub(moment, turned)))};
}

/* x: X 0:3, Q 3:7, p 7:10, h 10:13, r_px 13, p_px 14, V_b 15. The moving mass is locked or driven unless `free`. */
static inline void rates(const params *p, const double *x, const controls *u, const water *w, int free, double *out)
{
    const mat3 R = rotation(x + 3);
    const vec3 zeta = v3(R.a[6], R.a[7], R.a[8]);
    const vec3 momentum = v3(x[7], x[8], x[9]), angular = v3(x[10], x[11], x[12]);
    const double r_px = x[13], p_px = x[14], V_b = x[15];
    const double m_p = p->m_p, axial = free ? 0.0 : 1.0;

    /* moving mass */
    double c = 1.0, s = 0.0;
    if (u->mu != 0.0) {
        c = cos(u->mu);
        s = sin(u->mu);
    }
    const vec3 r_p = v3(r_px, -p->R_p * s, p->R_p * c);
    const vec3 m_r = scale(m_p, r_p);
    const double cc = c * c, ss = s * s, cs = c * s;
    const double J_p_xy = c * p->J_p.xy - s * p->J_p.xz, J_p_xz = s * p->J_p.xy + c * p->J_p.xz;

    /* oil that has moved from the reservoir to the bladder */
    const double m_oil = p->rho_oil * V_b;
    const vec3 b = p->r_bl, d = p->r_res;
    const vec3 oil = scale(m_oil, sub(b, d));
    const double o_xx = m_oil * (b.x * b.x - d.x * d.x);
    const double o_yy = m_oil * (b.y * b.y - d.y * d.y);
    const double o_zz = m_oil * (b.z * b.z - d.z * d.z);

    /* generalised inertia [M C'; C J] */
    sym3 M = p->M_0;
    M.xx += axial * m_p;
    M.yy += m_p;
    M.zz += m_p;
    mat3 C = p->C_0;
    C.a[1] -= m_r.z + oil.z;
    C.a[2] += m_r.y + oil.y;
    C.a[3] += axial * m_r.z + oil.z;
    C.a[5] -= m_r.x + oil.x;
    C.a[6] -= axial * m_r.y + oil.y;
    C.a[7] += m_r.x + oil.x;
    const sym3 J = {
        .xx = p->J_0.xx + m_r.y * r_p.y + m_r.z * r_p.z + p->J_p.xx + o_yy + o_zz,
        .yy = p->J_0.yy + axial * m_r.z * r_p.z + m_r.x * r_p.x + cc * p->J_p.yy + ss * p->J_p.zz
              - 2.0 * cs * p->J_p.yz + o_xx + o_zz,
        .zz = p->J_0.zz + axial * m_r.y * r_p.y + m_r.x * r_p.x + ss * p->J_p.yy + cc * p->J_p.zz
              + 2.0 * cs * p->J_p.yz + o_xx + o_yy,
        .xy = p->J_0.xy - m_r.x * r_p.y + J_p_xy - m_oil * (b.x * b.y - d.x * d.y),
        .xz = p->J_0.xz - m_r.x * r_p.z + J_p_xz - m_oil * (b.x * b.z - d.x * d.z),
        .yz = p->J_0.yz - axial * m_r.y * r_p.z + cs * (p->J_p.yy - p->J_p.zz) + (cc - ss) * p->J_p.yz
              - m_oil * (b.y * b.z - d.y * d.z),
    };

    /* momenta of what moves inside the hull */
    const double axial_momentum = free ? p_px : m_p * u->r_px_dot;
    const double flow_rate = p->rho_oil * u->u_b;
    const vec3 p_in = add(v3(axial_momentum, -u->mu_dot * m_r.z, u->mu_dot * m_r.y), scale(flow_rate, sub(b, d)));
    const vec3 h_in = add(
        v3(u->mu_dot * (m_r.y * r_p.y + m_r.z * r_p.z + p->J_p.xx),
           axial_momentum * r_p.z + u->mu_dot * (J_p_xy - m_r.x * r_p.y),
           -axial_momentum * r_p.y + u->mu_dot * (J_p_xz - m_r.x * r_p.z)),
        scale(flow_rate, cross(d, b)));

    /* velocities */
    const vec3 U = mat_tmul(&R, w->U);
    const vec3 p_hull = add(sub(momentum, p_in), sym_mul(&p->M_f, U));
    const vec3 h_hull = add(sub(angular, h_in), mat_mul(&p->C_f, U));
    const sym3 M_inv = sym_inverse(&M);
    const vec3 v_0 = sym_mul(&M_inv, p_hull);
    const vec3 c1 = v3(C.a[0], C.a[1], C.a[2]), c2 = v3(C.a[3], C.a[4], C.a[5]), c3 = v3(C.a[6], C.a[7], C.a[8]);
    const vec3 d1 = sym_mul(&M_inv, c1), d2 = sym_mul(&M_inv, c2), d3 = sym_mul(&M_inv, c3);
    const sym3 schur = {
        J.xx - dot(c1, d1), J.yy - dot(c2, d2), J.zz - dot(c3, d3),
        J.xy - dot(c1, d2), J.xz - dot(c1, d3), J.yz - dot(c2, d3),
    };
    const sym3 schur_inv = sym_inverse(&schur);
    const vec3 omega = sym_mul(&schur_inv, sub(h_hull, v3(dot(c1, v_0), dot(c2, v_0), dot(c3, v_0))));
    const vec3 v = v3(v_0.x - (d1.x * omega.x + d2.x * omega.y + d3.x * omega.z),
                      v_0.y - (d1.y * omega.x + d2.y * omega.y + d3.y * omega.z),
                      v_0.z - (d1.z * omega.x + d2.z * omega.y + d3.z * omega.z));
    const vec3 v_r = sub(v, U);
    const vec3 w_x_r = cross(omega, r_p);
    const double r_px_dot = free ? p_px / m_p - v.x - w_x_r.x : u->r_px_dot;

    /* forces */
    const wrench f = viscous(p, v_r, omega, u->delta_r);
    const double V_veh = p->V_0 * (1.0 - p->kappa * w->P + p->alpha_T * (w->T - p->T_0)) + V_b;
    const double W = (p->m - w->rho * V_veh) * p->g;
    const vec3 moment_arm = sub(add(p->s_0, add(m_r, oil)), scale(w->rho * V_b, b));
    const vec3 a_U = mat_tmul(&R, w->DU_Dt);
    const vec3 f_U = scale(w->rho * V_veh, a_U);
    const vec3 m_bl = cross(scale(w->rho * V_b, b), a_U);
    const vec3 p_f = add(sym_mul(&p->M_f, v_r), mat_tmul(&p->C_f, omega));

    const vec3 X_dot = mat_mul(&R, v);
    const vec3 p_dot = add(add(cross(momentum, omega), scale(W, zeta)), add(f.force, f_U));
    const vec3 h_dot = add(add(cross(angular, omega), cross(momentum, v)),
                           add(scale(p->g, cross(moment_arm, zeta)), add(sub(f.moment, cross(p_f, U)), m_bl)));

    /* attitude, pulled back to unit length */
    const double *q = x + 3;
    const double k = 0.5 * (1.0 - q[0] * q[0] - q[1] * q[1] - q[2] * q[2] - q[3] * q[3]);
    const vec3 half = scale(0.5, omega);
    out[0] = X_dot.x;
    out[1] = X_dot.y;
    out[2] = X_dot.z;
    out[3] = k * q[0] - q[1] * half.x - q[2] * half.y - q[3] * half.z;
    out[4] = k * q[1] + q[0] * half.x + q[2] * half.z - q[3] * half.y;
    out[5] = k * q[2] + q[0] * half.y + q[3] * half.x - q[1] * half.z;
    out[6] = k * q[3] + q[0] * half.z + q[1] * half.y - q[2] * half.x;
    out[7] = p_dot.x;
    out[8] = p_dot.y;
    out[9] = p_dot.z;
    out[10] = h_dot.x;
    out[11] = h_dot.y;
    out[12] = h_dot.z;
    out[13] = r_px_dot;
    out[14] = 0.0;
    if (free) {
        const vec3 v_p = add(add(v, w_x_r), v3(r_px_dot, -u->mu_dot * r_p.z, u->mu_dot * r_p.y));
        out[14] = m_p * (v_p.y * omega.z - v_p.z * omega.y) + m_p * p->g * zeta.x + u->u_px;
    }
    out[15] = u->u_b;
}

size_t params_size(void) { return sizeof(params); }

void derivative(const params *p, const double *x, const controls *u, const water *w, int free, double *out)
{
    rates(p, x, u, w, free, out);
}

/* `n` evaluations, each of which depends on the one before through x[7], so that none can be left out or overlap. */
double repeat(const params *p, double *x, const controls *u, const water *w, int free, double *out, long n)
{
    for (long i = 0; i < n; i++) {
        derivative(p, x, u, w, free, out);
        x[7] += 1e-12 * out[7];
    }
    return x[7];
}
