// Manual 1.15: lines, planes, spheres and circles through points (mm), by least squares.

#include "stdlib/impl/math/matrix.h"
#include "stdlib/impl/support/finite.h"

#include "natives/matrix.h"
#include "stdlib_constants.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <cmath>
#include <utility>

using namespace rt;

namespace {

using Points = Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kFlat = 1e-9; // relative: below it the points do not span what is asked for

struct Input {
    const double* rows; ///< n x 3, may be null
    int32_t count, columns;
    const data::Pos* positions; ///< the alternative
    int32_t positionCount;
    const float* used; ///< \NumPoints
};

Status readPoints(TaskCore* task, const Input& in, int least, Points& out) {
    const int32_t most = in.rows ? in.count : in.positionCount;
    const float wanted = in.used ? *in.used : static_cast<float>(most);
    if (!(wanted >= static_cast<float>(least) && wanted <= static_cast<float>(most)) ||
        (in.rows && in.columns < 3))
        return lib::fail(task, err::ERR_ARRAY_SIZE,
                         "the fit needs at least " + std::to_string(least) + " points of three coordinates");
    out.resize(3, static_cast<Eigen::Index>(wanted));
    for (Eigen::Index i = 0; i < out.cols(); ++i) {
        if (in.rows) {
            const double* row = in.rows + i * in.columns;
            out.col(i) = Vector3d(row[0], row[1], row[2]);
        } else {
            const data::Pos& p = in.positions[i];
            out.col(i) = Vector3d(p.x, p.y, p.z);
        }
    }
    return kOk;
}

Status undetermined(TaskCore* task) {
    return lib::fail(task, err::ERR_ARGVALERR, "the points do not determine what is to be fitted");
}

data::Pos toPos(const Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// Mean, and the directions of largest to smallest spread.
struct Spread {
    Vector3d mean;
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    Vector3d sizes = Vector3d::Zero();
    explicit Spread(const Points& points) : mean(points.rowwise().mean()) {
        const Points off = points.colwise() - mean;
        const Eigen::Matrix3d scatter = off.lazyProduct(off.transpose());
        const Eigen::JacobiSVD<Eigen::Matrix3d> svd(scatter, Eigen::ComputeFullU | Eigen::ComputeFullV);
        if (svd.info() != Eigen::Success) return; // coordinates beyond all bounds
        axes = svd.matrixU();
        sizes = svd.singularValues();
    }
    bool spans(int directions) const {
        return sizes(0) > 0 && (directions < 2 || sizes(directions - 1) > kFlat * sizes(0));
    }
};

/// The sign of a direction is free: the largest component is made positive, so that the result is unique.
Vector3d oriented(const Vector3d& direction) {
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    return direction(largest) < 0 ? Vector3d(-direction) : direction;
}

struct Optional {
    float* rms;
    float* maxErr;
    float* worst;
};

/// Stores nothing when a number is beyond the range of num. `shape`: what is fitted.
template <class... Shape>
Status giveFit(TaskCore* task, const Eigen::VectorXd& errors, const Optional& out, const Shape&... shape) {
    Eigen::Index index = 0;
    const auto largest = static_cast<float>(errors.cwiseAbs().maxCoeff(&index));
    const auto rms = static_cast<float>(std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size())));
    if (!lib::isFinite(largest) || !lib::isFinite(rms) || !(lib::isFinite(shape.second) && ...))
        return lib::tooLarge(task);
    ((*shape.first = shape.second), ...);
    if (out.rms) *out.rms = rms;
    if (out.maxErr) *out.maxErr = largest;
    if (out.worst) *out.worst = static_cast<float>(index + 1);
    return kOk;
}

/// Centre and radius of the best circle (2 rows) or sphere (3 rows): |p|^2 = 2 c.p + (r^2 - |c|^2) is linear in c.
template <int Rows>
bool centreOf(const Eigen::Matrix<double, Rows, Eigen::Dynamic>& p, Eigen::Matrix<double, Rows, 1>& centre,
              double& radius) {
    Eigen::MatrixXd a(p.cols(), Rows + 1);
    a << 2 * p.transpose(), Eigen::VectorXd::Ones(p.cols());
    const Eigen::VectorXd b = p.colwise().squaredNorm();
    Eigen::VectorXd solution;
    if (!lib::leastSquares(a, b, kFlat, solution)) return false;
    centre = solution.template head<Rows>();
    radius = std::sqrt(std::max(0.0, solution(Rows) + centre.squaredNorm()));
    return true;
}

Status fitCircle(TaskCore* task, const Input& in, data::Pos* center, float* radius, data::Pos* normal,
                 float* rms, float* maxErr, float* worst) {
    Points points;
    if (const Status status = readPoints(task, in, 3, points)) return status;
    const Spread spread(points);
    if (!spread.spans(2)) return undetermined(task);
    const Points local = spread.axes.transpose() * (points.colwise() - spread.mean);
    Eigen::Vector2d centre;
    double r = 0;
    if (!centreOf<2>(local.topRows<2>(), centre, r)) return undetermined(task);
    const Vector3d inPlane(centre.x(), centre.y(), 0);
    Eigen::VectorXd errors(points.cols());
    for (Eigen::Index i = 0; i < points.cols(); ++i)
        errors(i) = std::hypot((local.col(i).head<2>() - centre).norm() - r, local(2, i));
    return giveFit(
        task, errors, {rms, maxErr, worst}, std::pair(center, toPos(spread.mean + spread.axes * inPlane)),
        std::pair(radius, static_cast<float>(r)), std::pair(normal, toPos(oriented(spread.axes.col(2)))));
}

} // namespace

extern "C" {

Status rt_FitLine(TaskCore* task, const double* Rows, int32_t RowsDim1, int32_t RowsDim2,
                  const data::Pos* PointsPos, int32_t PointsPosDim1, const float* NumPoints, data::Pos* Point,
                  data::Pos* Direction, float* RMS, float* MaxErr, float* IndexWorst) {
    Points points;
    const Input in{Rows, RowsDim1, RowsDim2, PointsPos, PointsPosDim1, NumPoints};
    if (const Status status = readPoints(task, in, 2, points)) return status;
    const Spread spread(points);
    if (!spread.spans(1)) return undetermined(task);
    const Vector3d direction = spread.axes.col(0);
    Eigen::VectorXd errors(points.cols());
    for (Eigen::Index i = 0; i < points.cols(); ++i)
        errors(i) = direction.cross(points.col(i) - spread.mean).norm();
    return giveFit(task, errors, {RMS, MaxErr, IndexWorst}, std::pair(Point, toPos(spread.mean)),
                   std::pair(Direction, toPos(oriented(direction))));
}

Status rt_FitPlane(TaskCore* task, const double* Rows, int32_t RowsDim1, int32_t RowsDim2,
                   const data::Pos* PointsPos, int32_t PointsPosDim1, const float* NumPoints,
                   data::Pos* Point, data::Pos* Normal, float* RMS, float* MaxErr, float* IndexWorst) {
    Points points;
    const Input in{Rows, RowsDim1, RowsDim2, PointsPos, PointsPosDim1, NumPoints};
    if (const Status status = readPoints(task, in, 3, points)) return status;
    const Spread spread(points);
    if (!spread.spans(2)) return undetermined(task);
    const Vector3d normal = spread.axes.col(2);
    const Eigen::VectorXd errors = (points.colwise() - spread.mean).transpose() * normal;
    return giveFit(task, errors, {RMS, MaxErr, IndexWorst}, std::pair(Point, toPos(spread.mean)),
                   std::pair(Normal, toPos(oriented(normal))));
}

Status rt_FitSphere(TaskCore* task, const double* Rows, int32_t RowsDim1, int32_t RowsDim2,
                    const data::Pos* PointsPos, int32_t PointsPosDim1, const float* NumPoints,
                    data::Pos* Center, float* Radius, float* RMS, float* MaxErr, float* IndexWorst) {
    Points points;
    const Input in{Rows, RowsDim1, RowsDim2, PointsPos, PointsPosDim1, NumPoints};
    if (const Status status = readPoints(task, in, 4, points)) return status;
    const Vector3d mean = points.rowwise().mean();
    const Points local = points.colwise() - mean;
    Vector3d centre;
    double r = 0;
    if (!centreOf<3>(local, centre, r)) return undetermined(task);
    const Eigen::VectorXd errors = (local.colwise() - centre).colwise().norm().transpose().array() - r;
    return giveFit(task, errors, {RMS, MaxErr, IndexWorst}, std::pair(Center, toPos(mean + centre)),
                   std::pair(Radius, static_cast<float>(r)));
}

Status rt_FitCircle(TaskCore* task, const double* Rows, int32_t RowsDim1, int32_t RowsDim2,
                    const data::Pos* PointsPos, int32_t PointsPosDim1, const float* NumPoints,
                    data::Pos* Center, float* Radius, data::Pos* Normal, float* RMS, float* MaxErr,
                    float* IndexWorst) {
    return fitCircle(task, {Rows, RowsDim1, RowsDim2, PointsPos, PointsPosDim1, NumPoints}, Center, Radius,
                     Normal, RMS, MaxErr, IndexWorst);
}

Status rt_FitCirle(TaskCore* task, const double* Rows, int32_t RowsDim1, int32_t RowsDim2,
                   const data::Pos* PointsPos, int32_t PointsPosDim1, const float* NumPoints,
                   data::Pos* Center, float* Radius, data::Pos* Normal, float* RMS, float* MaxErr,
                   float* IndexWorst) {
    return fitCircle(task, {Rows, RowsDim1, RowsDim2, PointsPos, PointsPosDim1, NumPoints}, Center, Radius,
                     Normal, RMS, MaxErr, IndexWorst);
}
}
