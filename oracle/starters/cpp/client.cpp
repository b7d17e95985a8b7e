// The line protocol of raycert: reads a case a line, answers each with a line, flushed, in order.
//
// A double travels as a string of 16 hexadecimal digits, its bit pattern, because C++ has no JSON
// reader and this one would be longer if it read decimals. Any key order, blanks, escapes and
// unknown fields are read. Infinity is null.
#include "tracer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace {

// ---- JSON: a value is its text, and the values in it

constexpr int deepest = 1000;   // nesting that is read; what is deeper gets an error, not a crash

struct Value {
    std::string_view text;
    std::string key;            // of a member of an object
    std::vector<Value> items;   // of an object or an array

    bool is_string() const { return text.front() == '"'; }

    const Value* find(std::string_view name) const
    {
        for (const Value& item : items)
            if (item.key == name)
                return &item;
        return nullptr;
    }

    const Value& at(std::string_view name) const
    {
        if (const Value* item = find(name))
            return *item;
        throw std::invalid_argument(std::string(name) + " is missing");
    }
};

class Reader {
public:
    explicit Reader(std::string_view line) : rest(line) {}

    Value whole()
    {
        Value value = next(deepest);
        if (peek())
            throw std::invalid_argument("the line goes on after its JSON value");
        return value;
    }

private:
    std::string_view rest;      // what is not read yet

    // The next character that is not blank, NUL at the end.
    char peek()
    {
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
        return rest.empty() ? '\0' : rest.front();
    }

    bool skip(char wanted)
    {
        bool there = peek() == wanted;
        if (there)
            rest.remove_prefix(1);
        return there;
    }

    Value next(int depth)
    {
        if (depth == 0)
            throw std::invalid_argument("the line is nested too deep");
        Value value;
        char first = peek();
        std::string_view begin = rest;
        if (first == '{' || first == '[')
            value.items = members(first == '{' ? '}' : ']', depth - 1);
        else if (first == '"')
            rest.remove_prefix(closing_quote() + 1);
        else    // a word or a number: none of them means anything here
            rest.remove_prefix(std::min(rest.find_first_of(" \t\r,:]}"), rest.size()));
        value.text = begin.substr(0, begin.size() - rest.size());
        if (value.text.empty())
            throw std::invalid_argument("the line is not JSON");
        return value;
    }

    std::vector<Value> members(char close, int depth)
    {
        std::vector<Value> items;
        rest.remove_prefix(1);
        if (skip(close))
            return items;
        do {
            std::string key;
            if (close == '}') {
                Value name = next(depth);
                if (!name.is_string() || !skip(':'))
                    throw std::invalid_argument("the line is not JSON");
                key = unescaped(name.text);
            }
            items.push_back(next(depth));
            items.back().key = std::move(key);
        } while (skip(','));
        if (!skip(close))
            throw std::invalid_argument("the line is not JSON");
        return items;
    }

    std::size_t closing_quote() const
    {
        for (std::size_t i = 1; i < rest.size(); i++) {
            if (rest[i] == '"')
                return i;
            if (rest[i] == '\\')
                i++;
        }
        throw std::invalid_argument("a string does not end");
    }

public:
    // The text in the quotes. Only ASCII matters here: any other escape becomes '?'.
    static std::string unescaped(std::string_view quoted)
    {
        std::string text;
        for (std::size_t i = 1; i + 1 < quoted.size(); i++) {
            char c = quoted[i];
            if (c == '\\') {
                c = quoted[++i];
                if (c == 'u') {
                    unsigned code = 0x80;
                    std::string digits(quoted.substr(i + 1, 4));
                    if (std::sscanf(digits.c_str(), "%4x", &code) != 1 || digits.size() < 4)
                        throw std::invalid_argument("a string has a bad escape");
                    c = code < 0x80 ? static_cast<char>(code) : '?';
                    i += 4;
                } else if (std::strchr("bfnrt", c)) {
                    c = '?';    // a control character
                }
            }
            text += c;
        }
        return text;
    }
};

// ---- the case

struct Unsupported {
    std::string_view type;  // quoted, as it came
};

double number(const Value& value)
{
    std::string digits(value.is_string() ? value.text.substr(1, value.text.size() - 2) : "");
    if (digits.size() != 16 || digits.find_first_not_of("0123456789abcdefABCDEF") != digits.npos)
        throw std::invalid_argument("a number is not a string of 16 hexadecimal digits");
    std::uint64_t bits = std::stoull(digits, nullptr, 16);
    double x;
    std::memcpy(&x, &bits, sizeof x);
    if (!std::isfinite(x))
        throw std::invalid_argument("a number is not finite");
    return x;
}

Vector vector(const Value& value)
{
    if (value.items.size() != 3)
        throw std::invalid_argument("a vector has not three numbers");
    return {number(value.items[0]), number(value.items[1]), number(value.items[2])};
}

Solid solid(const Value& form)
{
    static constexpr std::string_view names[] = {   // in the order of Type
        "half_space", "sphere", "infinite_cylinder", "slab", "cylinder",
        "union", "intersection", "difference",
    };
    const Value& type = form.at("type");
    std::string name = type.is_string() ? Reader::unescaped(type.text) : "";
    auto known = std::find(std::begin(names), std::end(names), name);
    if (known == std::end(names))
        throw Unsupported{type.text};
    Solid s;
    s.type = static_cast<Type>(known - std::begin(names));
    switch (s.type) {
    case Type::half_space:
        s.point = vector(form.at("point"));
        s.normal = vector(form.at("normal"));
        break;
    case Type::sphere:
        s.center = vector(form.at("center"));
        s.radius = number(form.at("radius"));
        break;
    case Type::infinite_cylinder:
    case Type::cylinder:
        s.radius = number(form.at("radius"));
        [[fallthrough]];
    case Type::slab:
        s.p = vector(form.at("p"));
        s.q = vector(form.at("q"));
        break;
    default:
        for (const Value& part : form.at("of").items)
            s.of.push_back(solid(part));
        if (s.of.empty())
            throw std::invalid_argument("a tree has no parts");
    }
    return s;
}

// ---- the answer

std::string spelled(double t)
{
    if (std::isinf(t))
        return "null";
    std::uint64_t bits;
    std::memcpy(&bits, &t, sizeof bits);
    char text[24];
    std::snprintf(text, sizeof text, "\"%016llx\"", static_cast<unsigned long long>(bits));
    return text;
}

std::string spelled(const Pairs& pairs)
{
    std::string text;
    for (auto [enter, leave] : pairs)
        text += (text.empty() ? "[" : ", [") + spelled(enter) + ", " + spelled(leave) + "]";
    return "[" + text + "]";
}

std::string answer(std::string_view line)
{
    std::string id;     // given back as it came
    try {
        Value form = Reader(line).whole();
        if (form.find("hello"))
            return hello;
        id = "\"id\": " + std::string(form.at("id").text) + ", ";
        const Value& ray = form.at("ray");
        Pairs pairs = intersect(solid(form.at("solid")),
                                {vector(ray.at("origin")), vector(ray.at("direction"))});
        return "{" + id + "\"intervals\": " + spelled(pairs) + "}";
    } catch (const Unsupported& what) {
        return "{" + id + "\"unsupported\": " + std::string(what.type) + "}";
    } catch (const std::exception& error) {
        return "{" + id + "\"error\": \"" + error.what() + "\"}";
    }
}

}  // namespace

int main()
{
    std::ios::sync_with_stdio(false);
    for (std::string line; std::getline(std::cin, line);)
        std::cout << answer(line) << std::endl;     // endl flushes
}
