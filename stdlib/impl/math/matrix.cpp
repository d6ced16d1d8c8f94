// Manual 1.15: matrices. Results are computed completely before they are stored, so they may replace an operand.

#include "stdlib/impl/math/matrix.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/finite.h"

#include "natives/matrix.h"
#include "stdlib_constants.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>

using namespace rt;

namespace {

// Arrays of RAPID lie in memory row by row. All that is computed has Eigen's own order, so that each decomposition is
// compiled for one kind of matrix.
using Matrix = Eigen::MatrixXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using In = Eigen::Map<const Rows>;
using Out = Eigen::Map<Rows>;

constexpr double kSingular = 1e-13; // relative

Status badSize(TaskCore* task) {
    return lib::fail(task, err::ERR_ARRAY_SIZE, "the dimensions of the arrays do not fit together");
}

Status singular(TaskCore* task) {
    return lib::fail(task, err::ERR_ARGVALERR, "the matrix is singular");
}

/// The upper left part in use: \A_m rows, \A_n columns.
Status inUse(TaskCore* task, const double* a, int32_t rows, int32_t columns, const float* m, const float* n,
             Matrix& out) {
    const float usedRows = m ? *m : static_cast<float>(rows);
    const float usedColumns = n ? *n : static_cast<float>(columns);
    if (!(usedRows >= 1 && usedRows <= static_cast<float>(rows) && usedColumns >= 1 &&
          usedColumns <= static_cast<float>(columns)))
        return badSize(task);
    out = In(a, rows, columns)
              .topLeftCorner(static_cast<Eigen::Index>(usedRows), static_cast<Eigen::Index>(usedColumns));
    return kOk;
}

/// Into the upper left corner of an array that may be larger; the rest becomes 0.
Status store(TaskCore* task, const Matrix& value, double* out, int32_t rows, int32_t columns) {
    if (value.rows() > rows || value.cols() > columns) return badSize(task);
    if (!value.allFinite()) return lib::tooLarge(task);
    Out target(out, rows, columns);
    target.setZero();
    target.topLeftCorner(value.rows(), value.cols()) = value;
    return kOk;
}

} // namespace

bool rt::lib::leastSquares(const Matrix& a, const Eigen::VectorXd& b, double threshold, Eigen::VectorXd& x) {
    Eigen::ColPivHouseholderQR<Matrix> qr(a);
    qr.setThreshold(threshold);
    if (qr.rank() < a.cols()) return false;
    x = qr.solve(b);
    return true;
}

extern "C" {

Status rt_MatrixAdd(TaskCore* task, const double* A, int32_t ADim1, int32_t ADim2, const double* B,
                    int32_t BDim1, int32_t BDim2, double* C, int32_t CDim1, int32_t CDim2) {
    if (ADim1 != BDim1 || ADim2 != BDim2 || ADim1 != CDim1 || ADim2 != CDim2) return badSize(task);
    const Matrix sum = In(A, ADim1, ADim2) + In(B, BDim1, BDim2);
    return store(task, sum, C, CDim1, CDim2);
}

Status rt_MatrixSub(TaskCore* task, const double* A, int32_t ADim1, int32_t ADim2, const double* B,
                    int32_t BDim1, int32_t BDim2, double* C, int32_t CDim1, int32_t CDim2) {
    if (ADim1 != BDim1 || ADim2 != BDim2 || ADim1 != CDim1 || ADim2 != CDim2) return badSize(task);
    const Matrix difference = In(A, ADim1, ADim2) - In(B, BDim1, BDim2);
    return store(task, difference, C, CDim1, CDim2);
}

Status rt_MatrixMult(TaskCore* task, const double* A, int32_t ADim1, int32_t ADim2, const double* B,
                     int32_t BDim1, int32_t BDim2, const double* Scalar, double* C, int32_t CDim1,
                     int32_t CDim2) {
    if (B && ADim2 != BDim1) return badSize(task);
    if (CDim1 != ADim1 || CDim2 != (B ? BDim2 : ADim2)) return badSize(task);
    Matrix product;
    if (B)
        product = Matrix(In(A, ADim1, ADim2)) * Matrix(In(B, BDim1, BDim2));
    else
        product = In(A, ADim1, ADim2) * *Scalar;
    return store(task, product, C, CDim1, CDim2);
}

Status rt_MatrixReset(TaskCore*, double* A, int32_t ADim1, int32_t ADim2) {
    std::fill_n(A, static_cast<size_t>(ADim1) * static_cast<size_t>(ADim2), 0.0);
    return kOk;
}

Status rt_MatrixTranspose(TaskCore* task, const double* A, int32_t ADim1, int32_t ADim2, double* AT,
                          int32_t ATDim1, int32_t ATDim2) {
    if (ADim1 != ATDim2 || ADim2 != ATDim1) return badSize(task);
    const Matrix transposed = In(A, ADim1, ADim2).transpose();
    return store(task, transposed, AT, ATDim1, ATDim2);
}

Status rt_MatrixInverse(TaskCore* task, const double* A, int32_t ADim1, int32_t ADim2, double* AInv,
                        int32_t AInvDim1, int32_t AInvDim2) {
    if (ADim1 != ADim2 || AInvDim1 != ADim1 || AInvDim2 != ADim2) return badSize(task);
    const Eigen::FullPivLU<Matrix> lu{Matrix(In(A, ADim1, ADim2))};
    if (!lu.isInvertible()) return singular(task);
    return store(task, lu.inverse(), AInv, AInvDim1, AInvDim2);
}

/// More equations than unknowns: least squares.
Status rt_MatrixSolve(TaskCore* task, const double* A, int32_t ADim1, int32_t ADim2, const float* A_m,
                      const float* A_n, const double* b, int32_t bDim1, double* x, int32_t xDim1) {
    Matrix a;
    if (const Status status = inUse(task, A, ADim1, ADim2, A_m, A_n, a)) return status;
    if (a.rows() < a.cols() || bDim1 < a.rows() || xDim1 < a.cols()) return badSize(task);
    Eigen::VectorXd solution;
    if (!lib::leastSquares(a, Eigen::Map<const Eigen::VectorXd>(b, a.rows()), kSingular, solution))
        return singular(task);
    return store(task, solution, x, xDim1, 1);
}

Status rt_MatrixSolveQR(TaskCore* task, const double* A, int32_t ADim1, int32_t ADim2, const float* A_m,
                        const float* A_n, double* Q, int32_t QDim1, int32_t QDim2, double* R, int32_t RDim1,
                        int32_t RDim2) {
    Matrix a;
    if (const Status status = inUse(task, A, ADim1, ADim2, A_m, A_n, a)) return status;
    const Eigen::HouseholderQR<Matrix> qr(a);
    const Matrix q = qr.householderQ() * Matrix::Identity(a.rows(), a.rows());
    const Matrix r = qr.matrixQR().template triangularView<Eigen::Upper>();
    if (q.rows() > QDim1 || q.cols() > QDim2 || r.rows() > RDim1 || r.cols() > RDim2) return badSize(task);
    if (!q.allFinite() || !r.allFinite()) return lib::tooLarge(task);
    store(task, q, Q, QDim1, QDim2);
    return store(task, r, R, RDim1, RDim2);
}

Status rt_MatrixSVD(TaskCore* task, const double* A, int32_t ADim1, int32_t ADim2, const float* A_m,
                    const float* A_n, double* U, int32_t UDim1, int32_t UDim2, double* S, int32_t SDim1,
                    double* V, int32_t VDim1, int32_t VDim2, bool Econ) {
    Matrix a;
    if (const Status status = inUse(task, A, ADim1, ADim2, A_m, A_n, a)) return status;
    const unsigned how =
        Econ ? Eigen::ComputeThinU | Eigen::ComputeThinV : Eigen::ComputeFullU | Eigen::ComputeFullV;
    const Eigen::JacobiSVD<Matrix> svd(a, how);
    const Matrix u = svd.matrixU();
    const Matrix s = svd.singularValues();
    const Matrix v = svd.matrixV();
    if (u.rows() > UDim1 || u.cols() > UDim2 || s.rows() > SDim1 || v.rows() > VDim1 || v.cols() > VDim2)
        return badSize(task);
    if (!u.allFinite() || !s.allFinite() || !v.allFinite()) return lib::tooLarge(task);
    store(task, u, U, UDim1, UDim2);
    store(task, s, S, SDim1, 1);
    return store(task, v, V, VDim1, VDim2);
}
}
