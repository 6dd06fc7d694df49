#include "xdmf.hpp"

#include <array>
#include <cstdio>
#include <sstream>

namespace littoral::support {
namespace {

// A step stands at this margin, all that is in it deeper: so xdmf_steps() finds its end.
const std::string k_margin = "      ";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string exact(double number) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.17g", number);
  return text.data();
}

std::string data_item(const std::string& shape, const std::string& h5, const std::string& dataset,
                      const std::string& type = "Float\" Precision=\"8") {
  return "<DataItem Format=\"HDF\" NumberType=\"" + type + "\" Dimensions=\"" + shape + "\">" + escaped(h5) +
         ":/" + escaped(dataset) + "</DataItem>";
}

std::string attribute(const OutputField& field, const std::string& center, const std::string& shape,
                      const std::string& h5, const std::string& dataset) {
  const bool vector = field.components == 3;
  return "<Attribute Name=\"" + escaped(field.name) + "\" AttributeType=\"" + (vector ? "Vector" : "Scalar") +
         "\" Center=\"" + center + "\">" + data_item(shape + (vector ? " 3" : ""), h5, dataset) +
         "</Attribute>\n";
}

std::string begin_step(int step, const std::string& rest) {
  return k_margin + "<Grid Name=\"step " + std::to_string(step) + "\" " + rest + ">\n";
}

std::string time_line(double time) { return k_margin + "  <Time Value=\"" + exact(time) + "\"/>\n"; }

}  // namespace

std::string xdmf_points(int step, double time, const std::string& h5, std::size_t n_points,
                        const std::vector<OutputField>& fields) {
  const std::string n = std::to_string(n_points);
  const std::string inner = k_margin + "  ";
  std::string out = begin_step(step, "GridType=\"Uniform\"") + time_line(time);
  // ParaView's newer reader shows points without this list as no cells at all
  out += inner + "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" + n +
         "\" NodesPerElement=\"1\">" + data_item(n + " 1", h5, "vertices", "Int\" Precision=\"4") +
         "</Topology>\n";
  out += inner + "<Geometry GeometryType=\"XYZ\">" + data_item(n + " 3", h5, "xyz") + "</Geometry>\n";
  for (const auto& field : fields) out += inner + attribute(field, "Node", n, h5, field.name);
  return out + k_margin + "</Grid>\n";
}

std::string xdmf_blocks(int step, double time, const std::string& h5,
                        const std::vector<FieldSeries::Block>& blocks) {
  const std::string inner = k_margin + "    ";
  std::string out = begin_step(step, "GridType=\"Collection\" CollectionType=\"Spatial\"") + time_line(time);
  for (const auto& block : blocks) {
    // XDMF names the slowest direction first
    const auto shape = [&](int more) {
      std::string text;
      for (const std::size_t d : {2U, 1U, 0U})
        text += (text.empty() ? "" : " ") + std::to_string(block.cells[d] + more);
      return text;
    };
    out += k_margin + "  <Grid Name=\"" + escaped(block.name) + "\" GridType=\"Uniform\">\n";
    out += inner + "<Topology TopologyType=\"3DSMesh\" Dimensions=\"" + shape(1) + "\"/>\n";
    out += inner + "<Geometry GeometryType=\"XYZ\">" + data_item(shape(1) + " 3", h5, block.name + "/nodes") +
           "</Geometry>\n";
    for (const auto& field : block.cell_fields)
      out += inner + attribute(field, "Cell", shape(0), h5, block.name + "/" + field.name);
    out += k_margin + "  </Grid>\n";
  }
  return out + k_margin + "</Grid>\n";
}

std::string xdmf_file(const std::string& name, const std::vector<std::string>& steps) {
  std::string out = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n    <Grid Name=\"" +
                    escaped(name) + "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const auto& step : steps) out += step;
  return out + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

std::vector<XdmfStep> xdmf_steps(const std::string& file) {
  std::vector<XdmfStep> steps;
  std::istringstream lines(file);
  std::string line;
  XdmfStep current;
  bool inside = false;
  const std::string head = k_margin + "<Grid Name=\"step ";
  while (std::getline(lines, line)) {
    if (line.rfind(head, 0) == 0) {
      current = {std::atoi(line.c_str() + head.size()), 0.0, ""};
      inside = true;
    }
    if (!inside) continue;
    current.text += line + "\n";
    const std::string time = k_margin + "  <Time Value=\"";
    if (line.rfind(time, 0) == 0) current.time = std::strtod(line.c_str() + time.size(), nullptr);
    if (line == k_margin + "</Grid>") {
      steps.push_back(current);
      inside = false;
    }
  }
  return steps;
}

}  // namespace littoral::support
