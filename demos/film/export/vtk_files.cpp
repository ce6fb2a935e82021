// Files of VTK's XML formats.
#include "demos/film/export/vtk_files.h"

#include <fmt/format.h>

#include <bit>

#include "host/files/file.h"
#include "host/files/growing_file.h"

namespace scree::demos {

namespace {

// The XML in front of the arrays, and the arrays behind it, each with its length.
class Document {
public:
    Document(const char* type, double time) {
        const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
        head_ = fmt::format(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n", type,
            order);
        time_ = fmt::format(
            "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n"
            "</FieldData>\n",
            time);
    }
    void say(std::string_view text) { head_ += text; }
    void say_time() { head_ += time_; }
    void put(std::string_view name, const char* type, std::size_t components, std::span<const std::byte> bytes) {
        head_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                             type, name, components, size_);
        arrays_.push_back(bytes);
        size_ += sizeof(std::uint64_t) + bytes.size();
    }
    void put(const VtkArray& array) { put(array.name, array.type, array.components, array.bytes); }
    void put_all(const char* of, const std::vector<VtkArray>& arrays) {
        head_ += fmt::format("<{}>\n", of);
        for (const VtkArray& array : arrays) put(array);
        head_ += fmt::format("</{}>\n", of);
    }
    void write(const std::filesystem::path& path) const {
        host::GrowingFile file(path);
        file.append(head_ + "<AppendedData encoding=\"raw\">\n_");
        for (const std::span<const std::byte> bytes : arrays_) {
            const std::uint64_t size[1] = {bytes.size()};
            file.append(std::as_bytes(std::span(size)));
            file.append(bytes);
        }
        file.append(std::string_view("\n</AppendedData>\n</VTKFile>\n"));
        file.commit();
    }

private:
    std::string head_, time_;
    std::vector<std::span<const std::byte>> arrays_;
    std::uint64_t size_ = 0;
};

}  // namespace

void write_vtk(const std::filesystem::path& path, double time, const VtkPolyData& data) {
    Document file("PolyData", time);
    file.say("<PolyData>\n");
    file.say_time();
    file.say(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOf{}=\"{}\">\n", data.points.size(), data.kind, data.ends.size()));
    file.put_all("PointData", data.of_points);
    file.put_all("CellData", data.of_cells);
    file.say("<Points>\n");
    file.put("Points", "Float32", 3, std::as_bytes(std::span(data.points)));
    file.say(fmt::format("</Points>\n<{}>\n", data.kind));
    file.put("connectivity", "Int64", 1, std::as_bytes(std::span(data.corners)));
    file.put("offsets", "Int64", 1, std::as_bytes(std::span(data.ends)));
    file.say(fmt::format("</{}>\n</Piece>\n</PolyData>\n", data.kind));
    file.write(path);
}

void write_vtk(const std::filesystem::path& path, double time, const VtkImage& image) {
    Document file("ImageData", time);
    const std::string extent = fmt::format("0 {} 0 {} 0 {}", image.cells.x, image.cells.y, image.cells.z);
    file.say(fmt::format("<ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\">\n", extent, image.lower.x,
                         image.lower.y, image.lower.z, image.cell.x, image.cell.y, image.cell.z));
    file.say_time();
    file.say(fmt::format("<Piece Extent=\"{}\">\n<PointData>\n</PointData>\n", extent));
    file.put_all("CellData", image.of_cells);
    file.say("</Piece>\n</ImageData>\n");
    file.write(path);
}

void write_vtk_index(const std::filesystem::path& path, const std::vector<std::pair<double, std::string>>& files) {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (const auto& [time, file] : files) text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, file);
    host::write_atomically(path, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace scree::demos
