#include "acquisition/brdf/lobe_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shared/glsl.h"

namespace nacre {

namespace {

constexpr float kIor = 1.5f;
// B sets the lobe's width (1 / sqrt(B) radians), C its tail.
constexpr float kFirstB = 3, kLastB = 1e6f, kBStep = 3;
constexpr float kTails[] = {0.5f, 0.8f, 1.2f, 1.8f, 2.7f, 4, 6};
constexpr int kRefinements = 5;

struct Fit {
    AbcModel model;
    double error = std::numeric_limits<double>::max();
};

AbcModel lobeOf(float B, float C)
{
    AbcModel model;
    model.kD = glm::vec3(0);
    model.A = glm::vec3(1);
    model.B = B;
    model.C = C;
    model.ior = kIor;
    return model;
}

// min |w (f - d / pi - a s)| with d, a >= 0, of one channel: the unconstrained solution, or one of the borders.
struct Channel {
    double dd = 0, ds = 0, ss = 0, df = 0, sf = 0, ff = 0;

    double errorOf(double d, double a) const
    {
        return ff - 2 * (d * df + a * sf) + d * d * dd + 2 * d * a * ds + a * a * ss;
    }
    double solve(float& diffuse, float& specular) const
    {
        const double determinant = dd * ss - ds * ds;
        double d = 0, a = 0;
        if (determinant > 1e-9 * dd * ss) {
            d = (df * ss - sf * ds) / determinant;
            a = (sf * dd - df * ds) / determinant;
        }
        if (!(d >= 0 && a >= 0 && d + a > 0)) {
            const double dAlone = dd > 0 ? std::max(0.0, df / dd) : 0, aAlone = ss > 0 ? std::max(0.0, sf / ss) : 0;
            const bool diffuseWins = errorOf(dAlone, 0) <= errorOf(0, aAlone);
            d = diffuseWins ? dAlone : 0;
            a = diffuseWins ? 0 : aAlone;
        }
        diffuse = static_cast<float>(d);
        specular = static_cast<float>(a);
        return errorOf(d, a);
    }
};

Fit fitAmplitudes(const std::vector<BrdfMeasurement>& measurements, const AbcModel& lobe)
{
    Channel channels[3];
    for (const BrdfMeasurement& m : measurements) {
        const double weight = static_cast<double>(m.weight) * m.weight, diffuse = 1 / kPi;
        const double shape = evaluate(lobe, m.n, m.l, m.v).x;
        for (int c = 0; c < 3; ++c) {
            Channel& channel = channels[c];
            channel.dd += weight * diffuse * diffuse;
            channel.ds += weight * diffuse * shape;
            channel.ss += weight * shape * shape;
            channel.df += weight * diffuse * m.f[c];
            channel.sf += weight * shape * m.f[c];
            channel.ff += weight * m.f[c] * m.f[c];
        }
    }
    Fit fit{lobe, 0};
    for (int c = 0; c < 3; ++c) {
        fit.error += channels[c].solve(fit.model.kD[c], fit.model.A[c]);
    }
    return fit;
}

void tryLobe(const std::vector<BrdfMeasurement>& measurements, float B, float C, Fit& best)
{
    const Fit fit = fitAmplitudes(measurements, lobeOf(B, C));
    if (fit.error < best.error) {
        best = fit;
    }
}

} // namespace

AbcModel fitLambert(const std::vector<BrdfMeasurement>& measurements)
{
    AbcModel none = lobeOf(1, 1);
    none.A = glm::vec3(0); // a shape of 0 leaves the diffuse part alone
    AbcModel model = fitAmplitudes(measurements, none).model;
    model.A = glm::vec3(0);
    return model;
}

AbcModel fitLobe(const std::vector<BrdfMeasurement>& measurements)
{
    Fit best;
    for (float B = kFirstB; B <= kLastB; B *= kBStep) {
        for (const float C : kTails) {
            tryLobe(measurements, B, C, best);
        }
    }
    float stepB = std::sqrt(kBStep), stepC = 1.22f;
    for (int round = 0; round < kRefinements; ++round) {
        const float B = best.model.B, C = best.model.C;
        for (const float b : {B / stepB, B, B * stepB}) {
            for (const float c : {C / stepC, C, C * stepC}) {
                tryLobe(measurements, b, c, best);
            }
        }
        stepB = std::sqrt(stepB);
        stepC = std::sqrt(stepC);
    }
    return best.model;
}

} // namespace nacre
