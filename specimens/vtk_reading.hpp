// VTK's readers as this program wants them: what they complain about is kept, what they cannot get memory for is said.
#pragma once

#include <vtkDataArraySelection.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>

namespace proveta::vtk {

// Keeps what VTK's readers complain about, instead of the screen. They do so through their own events, through those of their parts and
// through none at all; all of it ends up here.
class Complaints : public vtkOutputWindow {
  public:
    static Complaints* New() { VTK_STANDARD_NEW_BODY(Complaints); }
    Complaints(const Complaints&) = delete;
    Complaints& operator=(const Complaints&) = delete;

    void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override { keep(text); }
    void DisplayGenericWarningText(const char* text) override { keep(text); }
    void DisplayWarningText(const char*) override {}
    void DisplayDebugText(const char*) override {}

    [[nodiscard]] bool any() const { return !first_.empty(); }
    // VTK's own words come as "ERROR: In file, line n\nclass (address): what".
    [[nodiscard]] std::string what() const {
        std::string out = first_.substr(0, first_.find_last_not_of(" \t\r\n\v\f") + 1);
        const auto line = out.find('\n');
        out = line == std::string::npos ? out : out.substr(line + 1);
        const auto object = out.find("): ");
        out = object == std::string::npos ? out : out.substr(object + 3);
        std::replace(out.begin(), out.end(), '\n', ' ');
        return out;
    }

  protected:
    Complaints() = default;

  private:
    void keep(const char* text) {
        if (first_.empty() && text != nullptr) {
            first_ = text;
        }
    }
    std::string first_;
};

// Puts VTK's output window in another's place, its log off and its words on, which other parts of the program turn off for all; and all of
// it back when it goes.
class WindowKept {
  public:
    explicit WindowKept(vtkOutputWindow* other)
        : old_(vtkOutputWindow::GetInstance()), display_(vtkObject::GetGlobalWarningDisplay()),
          verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
        vtkOutputWindow::SetInstance(other);
        vtkObject::GlobalWarningDisplayOn();
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    }
    ~WindowKept() {
        vtkLogger::SetStderrVerbosity(verbosity_);
        vtkObject::SetGlobalWarningDisplay(display_);
        vtkOutputWindow::SetInstance(old_);
    }
    WindowKept(const WindowKept&) = delete;
    WindowKept& operator=(const WindowKept&) = delete;

  private:
    vtkSmartPointer<vtkOutputWindow> old_;
    vtkTypeBool display_;
    vtkLogger::Verbosity verbosity_;
};

/// What a reader made of a file, and what it complained about; "" where it did not.
template <class Data> struct Read {
    vtkSmartPointer<Data> data;
    std::string complaint;
};

/// Runs a reader. prepare: takes it and sets its file and what to leave out. Throws std::runtime_error, naming the file, where it asks for
/// more memory than there is.
template <class Reader, class Prepare> auto read_with(const std::string& file, const Prepare& prepare) {
    const vtkNew<Complaints> complaints;
    const WindowKept kept(complaints);
    try {
        const vtkNew<Reader> reader;
        prepare(*reader);
        reader->Update();
        using Data = std::remove_pointer_t<decltype(reader->GetOutput())>;
        return Read<Data>{reader->GetOutput(), complaints->what()};
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(file + ": announces more than there is memory for");
    } catch (const std::length_error&) {
        throw std::runtime_error(file + ": announces more than there is memory for");
    }
}

/// Runs a reader of VTK's XML files without their point and cell data.
template <class Reader> auto read_xml_with(const std::string& file) {
    return read_with<Reader>(file, [&](Reader& reader) {
        reader.SetFileName(file.c_str());
        reader.UpdateInformation();
        reader.GetPointDataArraySelection()->DisableAllArrays();
        reader.GetCellDataArraySelection()->DisableAllArrays();
    });
}

} // namespace proveta::vtk
