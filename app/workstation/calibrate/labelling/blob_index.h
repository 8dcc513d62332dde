#pragma once
// Blobs by place: the nearest one, or all within a distance, from a grid of cells.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace dottrack::calibrate {

class BlobIndex {
 public:
  BlobIndex() = default;
  // Blob i is at pixels[i] in layer layers[i]. The image is so large; a cell holds a blob or two.
  BlobIndex(std::span<const Eigen::Vector2d> pixels, std::span<const int> layers, int width_px,
            int height_px);

  // The nearest blob of the layer within the distance; -1: there is none.
  int nearest(int layer, const Eigen::Vector2d& at, double within_px) const;
  // The k nearest other blobs of blob i's layer, nearest first.
  std::vector<int> neighbours(int i, std::size_t k) const;
  // Blobs of the layer a square pixel.
  double density(int layer) const;
  std::size_t layers() const { return counts_.size(); }
  int layer_of(int blob) const { return layers_[static_cast<std::size_t>(blob)]; }

 private:
  template <class Take>
  void visit(int layer, const Eigen::Vector2d& at, double within_px, Take take) const;
  std::size_t cell(int layer, int column, int row) const;
  int column_of(double x) const;
  int row_of(double y) const;

  std::vector<Eigen::Vector2d> pixels_;
  std::vector<int> layers_;
  std::vector<std::size_t> counts_;  // of blobs, a layer
  std::vector<std::size_t> begin_;   // of each cell in order_
  std::vector<int> order_;
  double cell_px_ = 1.0;
  double area_px_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
};

}  // namespace dottrack::calibrate
