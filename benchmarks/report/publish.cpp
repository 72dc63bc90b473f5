#include "benchmarks/report/publish.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>

#include "benchmarks/harness/exit_codes.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/run_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/report/findings.h"
#include "benchmarks/report/measured.h"
#include "benchmarks/report/report_page.h"
#include "core/base/counted.h"
#include "core/plain/error.h"

namespace dartboard {

int exit_code(const Report& report) {
  return report.disagreements.empty() ? exit_code(std::span<const Claim>(report.claims)) : exit_disagrees;
}

namespace {

/// Prints a sentence before a signal ends the program.
class LastWords {
 public:
  LastWords() = default;
  ~LastWords() { set(""); }
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;

  void set(const std::string& sentence) {
    said() = sentence;
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, sentence.empty() ? SIG_DFL : &say);
  }

 private:
  static std::string& said() {
    static std::string text;
    return text;
  }
  static void say(int signal) {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, said().data(), said().size());
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
};

class Publisher : public StudyLog {
 public:
  explicit Publisher(const Publication& how) : how_(how) {
    if (!how.continues.empty()) earlier_.emplace(how.continues, study(), MeasuredFor::going_on);
    if (!how.derives.empty()) earlier_.emplace(how.derives, study(), MeasuredFor::deriving);
    if (how.out.empty() && !how.keeps_folder) return;
    folder_.emplace(run_path(how.out, how.label));
    manifest_ = begin_manifest(how.facts);
    manifest_["quick"] = how.quick;
    folder_->write_manifest(manifest_);
    findings_ = begin_findings(how.label);
  }

  void run(const std::vector<std::string>& arguments, const LineSink& on_line,
           const std::vector<std::string>& places) override {
    MeasuredOutput output;
    if (auto kept = earlier_ ? earlier_->take(arguments) : std::nullopt) {
      output = std::move(*kept);
      for (const std::string& line : output.lines) on_line(line);
    } else {
      try {
        const auto take = [&](std::string_view line) {
          output.lines.emplace_back(line);
          on_line(line);
        };
        StudyLog::run(arguments, take, places);
      } catch (const ProcessError& error) {
        output.failure = error.what();
      }
    }
    keep(arguments, output);
    if (!output.failure.empty()) throw ProcessError(output.failure);
  }

  nlohmann::json once(const std::string& what, const std::function<nlohmann::json()>& find) override {
    const std::vector<std::string> arguments{what};
    const auto kept = earlier_ ? earlier_->take(arguments) : std::nullopt;
    const MeasuredOutput output = kept ? *kept : MeasuredOutput{.lines = {json_text(find())}};
    keep(arguments, output);
    return nlohmann::json::parse(output.lines.at(0));
  }

  void say(const std::string& sentence) override {
    progress_.reset();
    std::FILE* to = how_.json ? stderr : stdout;
    tell(to, "{}\n", sentence);
    std::fflush(to);
  }

  void sample(const nlohmann::json& sample, const std::string& file, const std::string& folder) override {
    if (!folder_) return;
    Part& to = part(folder);
    auto lines = to.lines.find(file);
    if (lines == to.lines.end()) lines = to.lines.emplace(file, to.folder.json_lines(file)).first;
    lines->second.append(sample);
  }

  void begin(const std::string& label, std::size_t steps) override {
    progress_ = std::make_unique<Progress>(label, steps, how_.json);
  }
  void advance(std::string_view detail) override {
    if (progress_) progress_->advance(detail);
  }

  void finished(const Report& report, const std::string& folder) override {
    if (!report.silent) show(report);
    std::ranges::copy(report.claims, std::back_inserter(all_.claims));
    std::ranges::copy(report.disagreements, std::back_inserter(all_.disagreements));
    std::ranges::copy(report.troubles, std::back_inserter(all_.troubles));
    if (folder_) write(report, folder);
  }

  int end(const Report& last) {
    finished(last, "");
    last_words_.set("");
    const bool derives = earlier_ && earlier_->use() == MeasuredFor::deriving;
    if (derives && earlier_->left() > 0)
      throw IoError(fmt::format("{}: has {} that this program does not ask for", how_.derives,
                                counted(earlier_->left(), "output", "outputs")));
    if (earlier_ && !derives) {
      say(fmt::format("{} taken from {}.", counted(earlier_->taken(), "finished process", "finished processes"),
                      earlier_->folder().string()));
      manifest_["continues"] = {{"processes", earlier_->taken()}, {"manifest", earlier_manifest()}};
    }
    bool has_page = false;
    if (folder_) {
      if (measured_) measured_->pack();
      manifest_.update(nlohmann::json(last.facts));
      finish_manifest(manifest_);
      folder_->write_manifest(manifest_);
      const std::string trouble = derives ? "" : write_report({folder_->path()}, folder_->path() / report_name);
      has_page = trouble.empty() && !derives;
      keep_trouble(trouble);
    }
    if (how_.json) tell("{}\n", json_text(numbers(last), 2));
    if (!last.sentence.empty())
      say(last.sentence);
    else if (!all_.claims.empty())
      say((how_.quick ? "This was a quick run. " : "") + in_words(all_.claims));
    if (folder_)
      say(fmt::format("Written to {}{}.", folder_->path().string(),
                      has_page ? fmt::format(", with its page, {}", report_name) : ""));
    if (derives) return exit_agrees;
    if (exit_code(all_) != 0) return exit_disagrees;
    return all_.troubles.empty() ? exit_agrees : exit_io;
  }

 private:
  void show(const Report& report) {
    if (!report.opening.empty()) say(report.opening);
    for (const NamedTable& t : report.tables) {
      if (t.on_page) continue;
      std::string text = t.heading.empty() ? "" : t.heading + "\n\n";
      text += to_text(t.table);
      if (!t.note.empty()) text += "\n" + t.note + "\n";
      say(text);
    }
    if (!report.claims.empty()) say("Claims\n\n" + to_text(report.claims));
    std::string limits;
    for (const std::string& limit : report.limits) limits += "- " + limit + "\n";
    if (!limits.empty()) say("What this does not show\n\n" + limits);
    for (const std::string& words : report.disagreements) say(words);
    for (const std::string& trouble : report.troubles) tell(stderr, "{}\n", trouble);
  }

  /// A folder within that of the run, or that itself, and its content so far; the run's own has all claims.
  struct Part {
    RunFolder folder;
    std::map<std::string, JsonLines> lines{};
    std::vector<Claim> claims{};
    void add(const std::vector<Claim>& more) {
      if (more.empty()) return;
      std::ranges::copy(more, std::back_inserter(claims));
      folder.write_claims(claims);
    }
  };
  Part& part(const std::string& name) {
    const auto known = parts_.find(name);
    if (known != parts_.end()) return known->second;
    return parts_.emplace(name, Part{name.empty() ? *folder_ : RunFolder(folder_->path() / name)}).first->second;
  }

  void write(const Report& report, const std::string& name) {
    const RunFolder& folder = part(name).folder;
    for (const auto& [file, value] : report.data_files) folder.write_json(file, value);
    part("").add(report.claims);
    if (!name.empty()) part(name).add(report.claims);
    for (const Picture& picture : report.pictures) {
      const std::string trouble =
          std::visit([&](const auto& what) { return draw(what, folder.path(), picture.name); }, picture.what);
      keep_trouble(trouble);
    }
    findings_["parts"].push_back(findings_of(report, name));
    part("").folder.write_json(findings_name, findings_);
  }

  /// Keeps what was measured; a program that is ended from now on says how to go on with it.
  void keep(const std::vector<std::string>& arguments, const MeasuredOutput& output) {
    if (!folder_) return;
    if (!measured_) {
      measured_.emplace(*folder_, earlier_ ? earlier_->by() : measured_by(study()));
      last_words_.set(fmt::format(
          "\ndartboard: what was measured is kept. The same command goes on with it, with --continue {} and "
          "another folder for --out, or none\n",
          folder_->path().string()));
    }
    measured_->add(arguments, output);
  }

  void keep_trouble(const std::string& trouble) {
    if (trouble.empty()) return;
    tell(stderr, "{}\n", trouble);
    all_.troubles.push_back(trouble);
  }

  nlohmann::ordered_json numbers(const Report& last) const {
    nlohmann::ordered_json json = last.numbers;
    if (json.is_array()) return json;
    if (!all_.claims.empty()) json["claims"] = nlohmann::json(all_.claims);
    if (folder_) json["manifest"] = manifest_;
    return json;
  }

  nlohmann::json study() const { return {{"label", how_.label}, {"quick", how_.quick}, {"seeds", how_.facts.seeds}}; }
  nlohmann::json earlier_manifest() const {
    std::ifstream in(earlier_->folder() / "manifest.json");
    return nlohmann::json::parse(in, nullptr, false);
  }

  const Publication& how_;
  std::optional<Measured> earlier_;
  std::optional<RunFolder> folder_;
  std::optional<MeasuredLog> measured_;
  LastWords last_words_;
  nlohmann::json manifest_, findings_;
  std::map<std::string, Part> parts_;  // by name; that of the run is ""
  std::unique_ptr<Progress> progress_;
  Report all_;  // claims, disagreements and troubles of all parts
};

}  // namespace

int publish(const Publication& how, const std::function<Report(StudyLog&)>& study) {
  Publisher publisher(how);
  return publisher.end(study(publisher));
}

}  // namespace dartboard
