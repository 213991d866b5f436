// CGAL as a contender: one Delaunay triangulation, or the two-pass crust of the paper.
//
//   cgal delaunay|crust FILE    FILE holds raw pairs of float64
//   cgal version
//
// Requests come as lines on standard input, answers go as JSON to standard output:
//
//   run K         do the work K times; mean seconds of wall and processor, without reading or freeing
//   edges PATH    do it once more, and write the edges as pairs of int32 rows

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/version.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// The row of a point, or -1 for a Voronoi vertex.
struct Row {
    std::int32_t value = -1;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Triangulation = CGAL::Delaunay_triangulation_2<Kernel>;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<Row, Kernel>;
using Rows = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
using Edges = std::vector<std::array<std::int32_t, 2>>;

std::vector<Point> read(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<Point> points;
    for (double xy[2]; file.read(reinterpret_cast<char*>(xy), sizeof xy);) points.emplace_back(xy[0], xy[1]);
    return points;
}

// CGAL sorts a range along a Hilbert curve, in randomized rounds, before it inserts it.
std::unique_ptr<Triangulation> triangulate(const std::vector<Point>& points) {
    return std::make_unique<Triangulation>(points.begin(), points.end());
}

std::unique_ptr<Rows> triangulate_rows(const std::vector<Point>& points) {
    std::vector<std::pair<Point, Row>> rows;
    rows.reserve(points.size());
    for (const Point& point : points) rows.emplace_back(point, Row{static_cast<std::int32_t>(rows.size())});
    return std::make_unique<Rows>(rows.begin(), rows.end());
}

Edges edges_between_points(const Rows& triangulation) {
    Edges edges;
    for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end(); ++edge) {
        const auto i = edge->first->vertex(Rows::ccw(edge->second))->info().value;
        const auto j = edge->first->vertex(Rows::cw(edge->second))->info().value;
        if (i >= 0 && j >= 0) edges.push_back({i, j});
    }
    return edges;
}

// The second pass adds the Voronoi vertices to the first, which spares it a third of the insertions.
std::unique_ptr<Edges> crust(const std::vector<Point>& points) {
    const auto triangulation = triangulate_rows(points);
    std::vector<Point> voronoi;
    voronoi.reserve(triangulation->number_of_faces());
    for (auto face = triangulation->finite_faces_begin(); face != triangulation->finite_faces_end(); ++face)
        voronoi.push_back(triangulation->dual(face));
    triangulation->insert(voronoi.begin(), voronoi.end());
    return std::make_unique<Edges>(edges_between_points(*triangulation));
}

double wall() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

template <class Work> void run(int repeats, const Work& work) {
    double wall_sum = 0, processor_sum = 0;
    for (int k = 0; k < repeats; ++k) {
        const double wall_start = wall(), processor_start = processor();
        const auto answer = work();
        wall_sum += wall() - wall_start;
        processor_sum += processor() - processor_start;
    }
    std::cout << "{\"wall\": " << wall_sum / repeats << ", \"cpu\": " << processor_sum / repeats << "}" << std::endl;
}

void write(const Edges& edges, const std::string& path) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(edges.data()), edges.size() * sizeof edges[0]);
    file.close();
    std::cout << "{\"edges\": " << edges.size() << "}" << std::endl;
}

int main(int count, char** arguments) {
    const std::string method = count > 1 ? arguments[1] : "";
    if (method == "version") {
        std::cout << CGAL_VERSION_STR << std::endl;
        return 0;
    }
    if (count != 3 || (method != "delaunay" && method != "crust")) {
        std::cerr << "usage: cgal delaunay|crust FILE, or cgal version" << std::endl;
        return 2;
    }
    const std::vector<Point> points = read(arguments[2]);
    std::cout.precision(9);
    std::cout << "{\"points\": " << points.size() << "}" << std::endl;
    for (std::string request, argument; std::cin >> request >> argument;) {
        if (request == "edges") write(method == "crust" ? *crust(points) : edges_between_points(*triangulate_rows(points)), argument);
        else if (method == "crust") run(std::stoi(argument), [&] { return crust(points); });
        else run(std::stoi(argument), [&] { return triangulate(points); });
    }
}
