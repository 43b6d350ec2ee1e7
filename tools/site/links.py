"""For MkDocs: pages link to files of the checkout, which the site has none of. Such files are copied to source/."""
import pathlib
import posixpath
import re

from mkdocs.structure.files import File

TOP = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"\[([^\]]*)\]\(\.\./([^)#]+)(#[^)]*)?\)")
PAGES = {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md"}


def linked():
    """Files of the checkout outside docs/ that pages link to."""
    texts = [page.read_text() for page in (TOP / "docs").glob("*.md")]
    return {path for text in texts for _, path, _ in LINK.findall(text) if (TOP / path).is_file()} | PAGES


def on_files(files, config):
    for path in sorted(linked()):
        made = File("source/" + path, config["docs_dir"], config["site_dir"], config["use_directory_urls"])
        made.abs_src_path = str(TOP / path)
        files.append(made)
    return files


def replaced(match):
    text, path, anchor = match.groups()
    if not (TOP / path).is_file():
        return text  # a folder
    return f"[{text}](source/{path}{anchor or ''})"


def on_page_markdown(markdown, page, config, files):
    if not page.file.src_path.startswith("source/"):
        return LINK.sub(replaced, markdown)
    # A page of the checkout's root: what it links to in docs/ is the site's.
    markdown = re.sub(r"\]\(docs/", "](../", markdown)
    return re.sub(r"\[([^\]]*)\]\((?!\.\./|[a-z]+:|#)([^)#]+)(#[^)]*)?\)",
                  lambda match: match.group(0) if match.group(2) in PAGES else match.group(1), markdown)
