// Least squares with unknowns between 0 and 1, by an accelerated gradient. Floor 3.
#pragma once
#include <vector>

namespace lfdsim {

/// Minimises |Mx - t|^2 + sum_j p_j (x_j - c_j)^2 over 0 <= x_j <= 1 for a matrix M >= 0, which the caller applies. It is FISTA (A.
/// Beck, M. Teboulle, SIAM J. Imaging Sci. 2, 2009) in the metric of the diagonal d = M'(M 1) + p, which bounds M'M + p for any
/// M >= 0, so that no step length has to be searched; it starts anew where it turns back (B. O'Donoghue, E. Candes, Found. Comput.
/// Math. 15, 2015). Errors may be weighted: M and t then contain the square roots of the weights.
class BoxSolver {
  public:
    /// `bound` = M'(M 1); where it is 0 no ray ends, and x stays at the start. p_j = prior for all others. Arrays are of one size.
    BoxSolver(std::vector<float> start, std::vector<float> centre, std::vector<float> bound, double prior);

    /// Returns the result of the last step.
    const std::vector<float>& x() const { return x_; }
    /// Returns y, the point at which the next step needs the gradient. Its numbers may lie outside 0 .. 1.
    const std::vector<float>& point() const { return point_; }
    /// Takes a step; `gradient` = M'(M point() - t), half that of the squares. It gives the same bits on any number of threads.
    void step(const std::vector<float>& gradient);

  private:
    const std::vector<float> centre_, bound_;
    const float prior_;
    std::vector<float> x_, point_;
    double pace_ = 1;  // t_k of FISTA
};

}  // namespace lfdsim
