// Annotations of frames by the program: boxes, masks and poses of balls and boxes before a pinhole camera, by closed forms.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "host/pictures/image.h"
#include "tests/program/program.h"

using nlohmann::json;
using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

constexpr int width = 200, height = 160;
constexpr double far = 6;  // m, of the camera on the z axis
const double focal = 0.5 * height / std::tan(20 * std::numbers::pi / 180);

// A ball half behind a screen, a crate in full view, a ball that the right edge cuts, and one that is hidden.
const std::string still = R"({"gravity": [0, 0, 0], "bodies": [
  {"name": "screen", "motion": "fixed", "shape": {"box": {"half_extents": [1, 1, 0.05]}}, "position": [-1, 0, 2]},
  {"name": "ball 1", "shape": {"sphere": {"radius": 0.5}}},
  {"name": "crate", "shape": {"box": {"half_extents": [0.3, 0.3, 0.3]}}, "position": [1.5, 1, 0]},
  {"name": "ball_02", "shape": {"sphere": {"radius": 0.5}}, "position": [2.7, -1, 0]},
  {"shape": {"sphere": {"radius": 0.25}}, "position": [-0.8, 0, 0]}],
  "camera": {"eye": [0, 0, 6], "target": [0, 0, 0], "vertical_fov": 40}})";

json annotated(const Place& place, const std::string& options) {
    const std::string scene = place.write("still.json", still);
    const Outcome run = run_scree("run '" + scene + "' --backend cpu --quiet --size 200x160 --canvas gl --fps 10 --seconds 0.1 " +
                                  options + " --frames '" + (place / "f").string() + "'");
    INFO(run.errors);
    REQUIRE(run.status == 0);
    return says(options, "coco") ? json::parse(place.read("f/annotations.json")) : json();
}

// Row by row, of COCO's run lengths.
std::vector<std::uint8_t> decoded(const json& segmentation) {
    const auto rows = segmentation.at("size").at(0).get<std::size_t>(),
               columns = segmentation.at("size").at(1).get<std::size_t>();
    std::vector<std::uint8_t> mask(rows * columns);
    std::size_t at = 0;
    std::uint8_t inside = 0;
    for (const json& count : segmentation.at("counts")) {
        for (std::size_t i = 0; i < count.get<std::size_t>(); ++i, ++at) mask.at(at % rows * columns + at / rows) = inside;
        inside ^= 1;
    }
    REQUIRE(at == mask.size());
    return mask;
}

std::vector<std::int32_t> ids_of(const std::string& npy) {
    const std::size_t begin = npy.find('\n') + 1;
    std::vector<std::int32_t> ids((npy.size() - begin) / 4);
    std::memcpy(ids.data(), npy.data() + begin, 4 * ids.size());
    REQUIRE(ids.size() == std::size_t{width} * height);
    return ids;
}

// Pixels of a ball's silhouette, which is an ellipse, as the camera on the z axis sees it.
double area_of_ball(double radius, double x, double y) {
    const double r2 = radius * radius, distance2 = x * x + y * y + far * far;
    return std::numbers::pi * focal * focal * r2 * std::sqrt(distance2 - r2) / std::pow(far * far - r2, 1.5);
}

const json& of_body(const json& annotations, int image, int body) {
    for (const json& one : annotations)
        if (one.at("image_id") == image && one.at("body") == body) return one;
    FAIL("no annotation of body " << body);
    return annotations;
}

std::size_t pixels_of_mask(const std::filesystem::path& file) {
    const scree::host::Image mask = scree::host::read_png(file);
    REQUIRE((mask.width == width && mask.height == height));
    std::size_t count = 0;
    for (std::size_t i = 0; i < mask.rgba.size(); i += 4) count += mask.rgba[i] == 255 ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("program: COCO's boxes, areas, masks and visibility are those of closed forms and of the channel ids", "[program]") {
    const Place place;
    const json set = annotated(place, "--annotations coco --channels ids --channel-files npy");
    REQUIRE(set.at("images").size() == 2);
    CHECK(set.at("images").at(1).at("file_name") == "frame_000001.png");
    CHECK(std::filesystem::exists(place / "f/frame_000001.png"));
    REQUIRE(set.at("categories").size() == 2);
    CHECK(set.at("categories").at(0).at("name") == "ball");
    CHECK(set.at("categories").at(1).at("name") == "crate");
    REQUIRE(set.at("annotations").size() == 6);  // the screen is background, and the small ball hidden
    std::vector<int> numbers;
    for (const json& one : set.at("annotations")) {
        numbers.push_back(one.at("id").get<int>());
        const std::vector<std::uint8_t> mask = decoded(one.at("segmentation"));
        const std::vector<std::int32_t> ids =
            ids_of(place.read("f/ids_00000" + std::to_string(one.at("image_id").get<int>()) + ".npy"));
        std::array<int, 4> box{width, height, -1, -1};
        std::size_t different = 0;
        for (int i = 0; i < width * height; ++i) {
            const auto k = static_cast<std::size_t>(i);
            different += (mask[k] != 0) != (ids[k] == one.at("body")) ? 1 : 0;
            if (mask[k] == 0) continue;
            box = {std::min(box[0], i % width), std::min(box[1], i / width), std::max(box[2], i % width),
                   std::max(box[3], i / width)};
        }
        CHECK(different == 0);
        CHECK(std::count(mask.begin(), mask.end(), 1) == one.at("area").get<int>());
        CHECK(one.at("bbox") == json({box[0], box[1], box[2] - box[0] + 1, box[3] - box[1] + 1}));
        CHECK(one.at("iscrowd") == 0);
    }
    CHECK(numbers == std::vector<int>{1, 2, 3, 4, 5, 6});
    const json& half = of_body(set.at("annotations"), 0, 1);
    CHECK(half.at("category_id") == 1);
    CHECK(half.at("visibility").get<double>() == Approx(0.5).margin(0.005));
    CHECK(half.at("area").get<double>() == Approx(area_of_ball(0.5, 0, 0) / 2).epsilon(0.01));
    CHECK(half.at("bbox").at(0) == width / 2);
    const json& crate = of_body(set.at("annotations"), 1, 2);
    CHECK(crate.at("visibility") == 1);
    CHECK(crate.at("category_id") == 2);
    // From the far left edge to the near right one, and from the near upper one to the far lower one.
    const auto pixel = [](double size, double slope) { return size / 2 + focal * slope - 0.5; };
    const double left = std::ceil(pixel(width, 1.2 / 6.3)), right = std::floor(pixel(width, 1.8 / 5.7)),
                 top = std::ceil(pixel(height, -1.3 / 5.7)), bottom = std::floor(pixel(height, -0.7 / 6.3));
    CHECK(crate.at("bbox") == json({int(left), int(top), int(right - left + 1), int(bottom - top + 1)}));
    const json& cut = of_body(set.at("annotations"), 0, 3);
    CHECK(cut.at("category_id") == 1);
    CHECK(cut.at("area").get<double>() / cut.at("visibility").get<double>() == Approx(area_of_ball(0.5, 2.7, -1)).epsilon(0.01));
    CHECK(cut.at("visibility").get<double>() < 0.6);
}

TEST_CASE("program: BOP's poses, counts, masks, depth and models are those of closed forms", "[program]") {
    const Place place;
    annotated(place, "--annotations bop");
    const std::string scene = "f/train/000000/";
    const json cameras = json::parse(place.read(scene + "scene_camera.json"));
    const json poses = json::parse(place.read(scene + "scene_gt.json"));
    const json info = json::parse(place.read(scene + "scene_gt_info.json"));
    const json models = json::parse(place.read("f/models/models_info.json"));
    REQUIRE((cameras.size() == 2 && poses.size() == 2 && info.size() == 2));
    CHECK(std::filesystem::exists(place / (scene + "rgb/000001.png")));
    CHECK_FALSE(std::filesystem::exists(place / "f/frame_000000.png"));
    const json& k = cameras.at("1").at("cam_K");
    CHECK(k.at(0).get<double>() == Approx(focal).epsilon(1e-5));
    CHECK(k.at(4).get<double>() == Approx(focal).epsilon(1e-5));
    CHECK(k.at(2).get<double>() == Approx((width - 1) / 2.0).epsilon(1e-5));
    CHECK(k.at(5).get<double>() == Approx((height - 1) / 2.0).epsilon(1e-5));
    CHECK(cameras.at("0").at("cam_R_w2c") == json({1, 0, 0, 0, -1, 0, 0, 0, -1}));
    CHECK(cameras.at("0").at("cam_t_w2c") == json({0, 0, 6000}));
    CHECK(json::parse(place.read("f/camera.json")).at("width") == width);
    const json& now = poses.at("1");
    REQUIRE(now.size() == 4);  // the hidden ball, too
    const std::vector<std::array<double, 3>> places = {{0, 0, 0}, {1.5, 1, 0}, {2.7, -1, 0}, {-0.8, 0, 0}};
    for (std::size_t i = 0; i < 4; ++i) {
        INFO(i);
        CHECK(now.at(i).at("body") == i + 1);
        const json& t = now.at(i).at("cam_t_m2c");
        CHECK(t.at(0).get<double>() == Approx(1000 * places[i][0]).margin(0.01));
        CHECK(t.at(1).get<double>() == Approx(-1000 * places[i][1]).margin(0.01));
        CHECK(t.at(2).get<double>() == Approx(6000).margin(0.01));
        const json& told = info.at("1").at(i);
        const std::string mask = "/000001_00000" + std::to_string(i) + ".png";
        CHECK(pixels_of_mask(place / (scene + "mask_visib" + mask)) == told.at("px_count_visib"));
        const std::size_t whole = pixels_of_mask(place / (scene + "mask" + mask));
        CHECK(whole == told.at("px_count_valid"));
        if (i != 2) CHECK(whole == told.at("px_count_all"));
        CHECK(told.at("visib_fract").get<double>() ==
              Approx(told.at("px_count_visib").get<double>() / told.at("px_count_all").get<double>()).margin(1e-5));
    }
    // A ball's centre is projected to the middle of its silhouette, but for the perspective's r^2 / z^2 of it.
    const json& ball = info.at("0").at(0);
    CHECK(ball.at("bbox_obj").at(0).get<double>() + 0.5 * (ball.at("bbox_obj").at(2).get<double>() - 1) ==
          Approx(k.at(2).get<double>()).margin(0.5));
    CHECK(ball.at("px_count_all").get<double>() == Approx(area_of_ball(0.5, 0, 0)).epsilon(0.01));
    CHECK(ball.at("visib_fract").get<double>() == Approx(0.5).margin(0.005));
    CHECK(ball.at("bbox_visib").at(0) == width / 2);
    const json& cut = info.at("0").at(2);
    CHECK(cut.at("px_count_all").get<double>() == Approx(area_of_ball(0.5, 2.7, -1)).epsilon(0.01));
    CHECK(cut.at("bbox_obj").at(0).get<int>() + cut.at("bbox_obj").at(2).get<int>() > width);
    const json& hidden = info.at("0").at(3);
    CHECK(hidden.at("px_count_visib") == 0);
    CHECK(hidden.at("bbox_visib") == json({-1, -1, -1, -1}));
    CHECK(hidden.at("px_count_all").get<double>() == Approx(area_of_ball(0.25, -0.8, 0)).epsilon(0.03));
    // Balls of one name and size share a model; that of the other ball is another.
    CHECK((now.at(0).at("obj_id") == 1 && now.at(1).at("obj_id") == 2 && now.at(2).at("obj_id") == 1));
    CHECK(now.at(3).at("obj_id") == 3);
    REQUIRE(models.size() == 3);
    CHECK(models.at("1").at("diameter").get<double>() == Approx(1000).epsilon(1e-4));
    CHECK(models.at("2").at("diameter").get<double>() == Approx(600 * std::sqrt(3.0)).epsilon(1e-5));
    CHECK(models.at("2").at("min_y").get<double>() == Approx(-300));
    CHECK(models.at("2").at("size_z").get<double>() == Approx(600));
    CHECK(models.at("3").at("name") == "sphere");
    CHECK(place.read("f/models/obj_000002.ply").starts_with("ply\n"));
    CHECK(std::filesystem::exists(place / "f/models/obj_000003.ply"));
    CHECK_FALSE(std::filesystem::exists(place / "f/models/obj_000004.ply"));
}

TEST_CASE("program: annotations of an earlier run are in the way, or replaced, and bad combinations are refused", "[program]") {
    const Place place;
    const auto run = [&](const std::string& options) {
        return run_scree("run '" + place.write("still.json", still) +
                         "' --backend cpu --quiet --size 64x48 --canvas gl --fps 10 --frames '" + (place / "f").string() + "' " +
                         options);
    };
    const auto refused = [&](const std::string& options, const std::string& words) {
        const Outcome outcome = run(options);
        INFO(options << "\n" << outcome.errors);
        CHECK(outcome.status == 2);
        CHECK(says(outcome.errors, words));
    };
    refused("--annotations bop --frame-files exr", "--annotations bop: not with --frame-files exr");
    refused("--annotations bop --channels ids", "not with --channels");
    refused("--annotations bop --orthographic", "not with --orthographic");
    refused("--annotations bop --background none", "not with --background none");
    refused("--annotations bop --png-depth 16", "not with --png-depth 16");
    refused("--annotations yolo", "coco, bop");
    refused("--annotations coco --copies 2", "--annotations: is of one scene");
    CHECK_FALSE(std::filesystem::exists(place / "f"));
    const Outcome none = run_scree("run stack --steps 1 --annotations coco");
    CHECK(none.status == 2);
    CHECK(says(none.errors, "--annotations: are files beside frames; add --frames DIR"));
    const std::string scene = "f/train/000000/";
    REQUIRE(run("--annotations bop --seconds 0.1").status == 0);
    refused("--annotations bop --seconds 0.1", "holds frames already");
    REQUIRE(std::filesystem::exists(place / (scene + "mask/000001_000000.png")));
    REQUIRE(run("--annotations bop --frame-at 0 --overwrite").status == 0);
    for (const char* file : {"rgb/000001.png", "mask/000001_000000.png", "mask_visib/000001_000000.png", "depth/000001.png"})
        CHECK_FALSE(std::filesystem::exists(place / (scene + file)));
    CHECK(json::parse(place.read(scene + "scene_gt.json")).size() == 1);
    REQUIRE(run("--annotations coco --frame-at 0").status == 0);
    std::filesystem::remove(place / "f/frame_000000.png");
    refused("--frame-at 0", "annotations.json");
    REQUIRE(run("--frame-at 0 --overwrite").status == 0);
    CHECK_FALSE(std::filesystem::exists(place / "f/annotations.json"));
}
